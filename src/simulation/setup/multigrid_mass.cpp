#include "simulation/setup/multigrid_mass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "linalg/lanczos.hpp"
#include "linalg/linear_map.hpp"
#include "linalg/multigrid.hpp"
#include "linalg/power_iteration.hpp"

namespace stillpoint {
namespace {

// F − R at the start: what it holds of a mode is what the run meets of it. If it is 0, any vector serves.
std::vector<double> out_of_balance(const LagrangianPhase& phase, ConstVec u) {
  std::vector<double> Q(phase.size()), R(phase.size());
  phase.external_force(0, u, Q);
  if (!phase.internal_force(0, u, R, *phase.make_trial())) return start_vector(phase.size());
  for (std::size_t i = 0; i < Q.size(); ++i) Q[i] -= R[i];
  return std::ranges::all_of(Q, [](double q) { return q == 0; }) ? start_vector(phase.size()) : Q;
}

// Both ends of the spectrum of B K by Lanczos' method. Ritz values are inside of it: what they miss is taken off ω₁²
// and added to ω_max². They have met all modes that the load drives once conjugate gradients would be at rest: one that
// is missed, as it is driven little, is slower than critical and creeps. False if one of them is negative.
bool find_frequencies(const LinearMap& apply_K, const std::vector<double>& load, bool only_omega_max,
                      MultigridMass& made) {
  constexpr int few = 4, most = 300;
  constexpr double rest = 1e-5;  // √(rᵀBr) beside that of the load
  const LinearMap solve = [&](ConstVec b, Vec x) { made.mass.solve(b, x); };
  Vector b = VectorSpace().make(made.mass.size());
  std::ranges::copy(load, b.span().begin());
  Lanczos lanczos(apply_K, solve, std::move(b));
  const int limit = only_omega_max ? few : most;
  while (lanczos.applications() < limit && lanczos.step()) {
    if (lanczos.applications() < few) continue;
    if (lanczos.applications() == few) made.spread = lanczos.largest().theta / lanczos.smallest().theta;
    if (lanczos.residual() <= rest) break;
  }
  made.applications = lanczos.applications();
  if (made.applications == 0 || !lanczos.finite()) return false;
  const Lanczos::Largest lowest = lanczos.smallest(), highest = lanczos.largest();
  if (!(lowest.theta > 0)) return false;
  made.omega_max = std::sqrt(highest.theta + highest.missing);
  if (!only_omega_max) made.omega_1 = std::sqrt(lowest.theta - std::min(lowest.error, lowest.theta / 2));
  return true;
}

// The diagonal entry of K for which there is no cycle, with its position; empty if there is none.
std::string why_no_cycle(const LagrangianPhase& phase, const SparseMatrix& K) {
  for (Eigen::Index k = 0; k < K.outerSize(); ++k) {
    if (K.coeff(k, k) > 0) continue;
    return fmt::format("the elastic stiffness of {} is {}, not positive",
                       to_string(phase.diagnosis().of_unknown(static_cast<std::size_t>(k))), K.coeff(k, k));
  }
  return "";
}

std::shared_ptr<MultigridMass> mass_of(std::shared_ptr<const Multigrid> cycle, std::size_t n) {
  auto made = std::make_shared<MultigridMass>();
  made->cycle = std::move(cycle);
  made->mass = Mass::by_inverse(n, [cycle = made->cycle](ConstVec b, Vec x) { cycle->apply(b, x); });
  return made;
}

std::shared_ptr<MultigridMass> mass_with_cycle_of(const SparseMatrix& K, const LagrangianPhase& phase) {
  NodalLayout layout = phase.shape().layout();
  auto made = mass_of(make_multigrid(K, layout), phase.size());
  made->layout = std::move(layout);
  return made;
}

MultigridAttempt with_frequencies(std::shared_ptr<MultigridMass> made, const LinearMap& apply_K,
                                  const LagrangianPhase& phase, ConstVec u, bool only_omega_max) {
  if (find_frequencies(apply_K, out_of_balance(phase, u), only_omega_max, *made)) return {std::move(made), ""};
  return {nullptr,
          "the elastic stiffness is not positive definite at the start: multigrid needs a body that is held, in a "
          "stable state; expected supports, or mass.kind = \"lumped\""};
}

}  // namespace

MultigridAttempt make_multigrid_mass(const LagrangianPhase& phase, ConstVec u, bool only_omega_max) {
  if (std::string missing = multigrid_is_missing(); !missing.empty()) return {nullptr, std::move(missing)};
  std::shared_ptr<MultigridMass> made;
  {  // K is given back as soon as there is a cycle
    const SparseMatrix K = phase.tangents().matrix(Tangent::elastic, 0, u);
    if (std::string why = why_no_cycle(phase, K); !why.empty()) return {nullptr, std::move(why)};
    made = mass_with_cycle_of(K, phase);
  }
  const LinearMap apply_K = [&](ConstVec x, Vec Kx) { phase.tangents().apply(Tangent::elastic, 0, u, x, Kx); };
  return with_frequencies(std::move(made), apply_K, phase, u, only_omega_max);
}

// The stable K leaves out what the stresses on the way make unstable: an inertia has to be positive definite.
MultigridAttempt next_multigrid_mass(const LagrangianPhase& phase, const MultigridMass* last) {
  constexpr double worse = 2;  // 3 and more save no time: what a phase costs beside is as much
  const std::vector<double> u(phase.size(), 0.0);
  const SparseMatrix K = phase.tangents().matrix(Tangent::stable, 0, u);
  if (std::string why = why_no_cycle(phase, K); !why.empty()) return {nullptr, std::move(why)};
  const LinearMap apply_K = row_product(K);
  const auto anew = [&] { return with_frequencies(mass_with_cycle_of(K, phase), apply_K, phase, u, true); };
  if (!last) return anew();
  const auto carried = mass_of(carry(last->cycle, last->layout, phase.shape().layout(), K), phase.size());
  const bool serves = find_frequencies(apply_K, out_of_balance(phase, u), /*only_omega_max=*/true, *carried) &&
                      carried->spread <= worse * last->spread;
  if (!serves) return anew();
  carried->cycle = last->cycle;
  carried->layout = last->layout;
  carried->spread = last->spread;
  return {carried, ""};
}

MultigridAttempt shared_multigrid_mass(SetUp& set_up, const MassSpec& mass, const LagrangianPhase& phase, ConstVec u,
                                       bool only_omega_max) {
  return set_up.shared(only_omega_max ? "multigrid without omega_1" : "multigrid", mass,
                       [&] { return make_multigrid_mass(phase, u, only_omega_max); });
}

}  // namespace stillpoint

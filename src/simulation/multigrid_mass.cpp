#include "simulation/multigrid_mass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "linalg/lanczos.hpp"
#include "linalg/multigrid.hpp"
#include "linalg/power_iteration.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/highest_frequency.hpp"

namespace stillpoint {
namespace {

const char* const key = "mass.kind";

// F − R at the start: what it holds of a mode is what the run meets of it. Any vector where it is 0.
std::vector<double> out_of_balance(const LagrangianPhase& phase, ConstVec u) {
  std::vector<double> Q(phase.size()), R(phase.size());
  phase.external_force(0, u, Q);
  if (!phase.internal_force(0, u, R, *phase.make_trial())) return start_vector(phase.size());
  for (std::size_t i = 0; i < Q.size(); ++i) Q[i] -= R[i];
  return std::ranges::all_of(Q, [](double q) { return q == 0; }) ? start_vector(phase.size()) : Q;
}

// Both ends of the spectrum of B K by Lanczos' method. Ritz values are inside of it: what they miss is taken off ω₁²
// and added to ω_max².
void find_frequencies(const Scene& scene, const LinearMap& apply_K, const std::vector<double>& load,
                      bool only_omega_max, MultigridMass& made) {
  constexpr int fewest = 4, most = 32;
  constexpr double accuracy = 0.05;
  const LinearMap solve = [&](ConstVec b, Vec x) { made.mass.solve(b, x); };
  Vector b = VectorSpace().make(made.mass.size());
  std::ranges::copy(load, b.span().begin());
  Lanczos lanczos(apply_K, solve, std::move(b));
  Lanczos::Largest lowest{}, highest{};
  for (int step = 1; step <= (only_omega_max ? fewest : most) && lanczos.step(); ++step) {
    if (step < fewest) continue;
    lowest = lanczos.smallest();
    highest = lanczos.largest();
    if (lowest.error <= accuracy * lowest.theta && highest.error <= accuracy * highest.theta) break;
  }
  made.applications = lanczos.applications();
  if (lanczos.applications() > 0) lowest = lanczos.smallest(), highest = lanczos.largest();
  if (!lanczos.finite() || !(lowest.theta > 0)) {
    throw_scene_error(scene, key,
                      "the elastic stiffness is not positive definite at the start: multigrid needs a body that is "
                      "held, in a stable state; expected supports, or mass.kind = \"lumped\"");
  }
  made.omega_max = std::sqrt(highest.theta + highest.missing);
  if (!only_omega_max) made.omega_1 = std::sqrt(lowest.theta - std::min(lowest.error, lowest.theta / 2));
}

}  // namespace

std::shared_ptr<const MultigridMass> make_multigrid_mass(const Scene& scene, const LagrangianPhase& phase, ConstVec u,
                                                         bool only_omega_max) {
  if (const std::string missing = multigrid_is_missing(); !missing.empty()) throw_scene_error(scene, key, missing);
  const auto made = std::make_shared<MultigridMass>();
  std::shared_ptr<const Multigrid> cycle;
  {
    const SparseMatrix K = phase.tangents().matrix(Tangent::elastic, 0, u);
    for (Eigen::Index k = 0; k < K.outerSize(); ++k) {
      if (!(K.coeff(k, k) > 0)) {
        throw_scene_error(
            scene, key,
            fmt::format("the elastic stiffness of {} is {}, not positive",
                        to_string(phase.diagnosis().of_unknown(static_cast<std::size_t>(k))), K.coeff(k, k)));
      }
    }
    cycle = make_multigrid(K, phase.layout());
  }
  made->mass = Mass::by_inverse(phase.size(), [cycle](ConstVec b, Vec x) { cycle->apply(b, x); });
  made->levels = cycle->levels();
  made->bytes = cycle->bytes();
  const LinearMap apply_K = [&](ConstVec x, Vec Kx) { phase.tangents().apply(Tangent::elastic, 0, u, x, Kx); };
  find_frequencies(scene, apply_K, out_of_balance(phase, u), only_omega_max, *made);
  return made;
}

// Seconds on a core of 2022, of which only the ratios count, measured by incompressible.toml with 1e4 to 3e5 unknowns:
// evaluations without multigrid grow with the cells across the body, those with it do not, and both cost as much as
// there are unknowns.
bool multigrid_pays(const Scene& scene, double unknowns) {
  constexpr double per_cell = 7.4;                          // evaluations to 1e-6, a cell along the longest side
  constexpr double evaluation = 12e-9, start = 0.12;        // [s an unknown], [s] of PETSc
  constexpr double set_up = 4.0e-6, cycles = 15 * 0.15e-6;  // [s an unknown]
  const bool is_open = !scene.where.contains("mass.scaling") && !scene.where.contains("mass.kind");
  if (!is_open || !wants_equilibrium_only(scene) || scene.stop.distance > 0) return false;
  if (scene.grid.basis == BasisKind::hermite || scene.grid.cells.empty()) return false;
  const double without = per_cell * *std::ranges::max_element(scene.grid.cells) * evaluation * unknowns;
  return without > start + (set_up + cycles) * unknowns && multigrid_is_missing().empty();
}

}  // namespace stillpoint

#include "simulation/watch/equilibrium_stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/parallel_loop.hpp"
#include "base/stop_request.hpp"
#include "linalg/sparse_lu.hpp"
#include "output/point_fields.hpp"
#include "scene/dimensions.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/own_files.hpp"
#include "simulation/watch/contact_alone.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"
#include "solvers/spectrum/lowest_mode.hpp"

namespace stillpoint {
namespace {

// Σ_p V_p |σ_p| |∇x_p|², a bound of the stresses' part of xᵀKx: what is out of balance changes it by such a share.
double stress_part(const LagrangianPhase& phase, double t, ConstVec u, ConstVec x) {
  const auto gradients = static_cast<std::size_t>(phase.info().gradient_components);
  const auto stresses = static_cast<std::size_t>(phase.info().stress_components);
  const std::vector<double> gradient = change_of(phase, PointQuantity::strain, t, x);
  const std::vector<double> volume = phase.fields().point_data().volumes;
  std::vector<double> stress(stresses * phase.points());
  phase.fields().point_stress(t, u, stress);
  const auto square = [](const std::vector<double>& values, std::size_t width, std::size_t p) {
    double sum = 0;
    for (std::size_t i = 0; i < width; ++i) sum += values[width * p + i] * values[width * p + i];
    return sum;
  };
  return sum_over(phase.points(), [&](std::size_t p) {
    return volume[p] * std::sqrt(square(stress, stresses, p)) * square(gradient, gradients, p);
  });
}

// True if a mode lives in functions that hardly reach the body: beside a point or two they are more unknowns than these
// resist, and what moves there is no material. Such functions have inertia that they were given in place of mass, or,
// scaled by Gershgorin, one that is small beside that of others, while no point moves as far as its nodes. Points stand
// still in an hourglass motion too, but the functions that this lives in are filled, and it is to be told.
bool moves_no_material(const LagrangianPhase& phase, double t, const std::vector<double>& x) {
  constexpr double added_share = 0.9;      // share of xᵀMx in inertia that was given, from which on x is no motion
  constexpr double material_share = 0.05;  // share of xᵀMx in the points, below which they do not move
  constexpr double light = 0.25;           // inertia of a light degree of freedom, relative to the largest one
  const Mass& M = phase.mass();
  if (2 * M.relative_energy(x) > added_share) return true;
  const ConstVec m = M.diagonal();
  const double of_mode = sum_over(x.size(), [&](std::size_t k) { return m[k] * m[k] * x[k] * x[k]; }),
               sum = sum_over(x.size(), [&](std::size_t k) { return m[k] * x[k] * x[k]; });
  if (!(of_mode < light * *std::ranges::max_element(m) * sum)) return false;
  const std::vector<double> moved = change_of(phase, PointQuantity::displacement, t, x);
  const std::vector<double> mass = phase.fields().point_data().masses;
  const auto dim = static_cast<std::size_t>(phase.dim());
  return sum_over(moved.size(), [&](std::size_t i) { return mass[i / dim] * moved[i] * moved[i]; }) < material_share;
}

// The lowest real λ of K x = λ M x with an unsymmetric K, from the one of its symmetric part, which is lower: by
// inverse iteration from below. False if there is no real one there.
bool find_real_mode(const SparseMatrix& K, const Mass& mass, LowestMode& lowest) {
  constexpr int most_iterations = 200;
  constexpr double accuracy = 1e-6;
  const double sigma = -2 * std::min(lowest.omega_squared, -lowest.rounding);
  const SparseLu factor(SparseMatrix(K + sigma * mass.matrix()));
  if (!factor.regular()) return false;
  const auto n = static_cast<Eigen::Index>(mass.size());
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(lowest.x.data(), n), Mx(n), y(n), My(n);
  const auto apply_M = [&](const Eigen::VectorXd& from, Eigen::VectorXd& to) {
    mass.apply({from.data(), mass.size()}, {to.data(), mass.size()});
  };
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    apply_M(x, Mx);
    factor.solve({Mx.data(), mass.size()}, {y.data(), mass.size()});
    apply_M(y, My);
    const double theta = x.dot(My), length = std::sqrt(y.dot(My));
    lowest.omega_squared = 1 / theta - sigma;
    const bool converged = length * length - theta * theta <= accuracy * accuracy * length * length;
    x = y / length;
    if (!converged) continue;
    lowest.x.assign(x.data(), x.data() + n);
    return true;
  }
  return false;
}

void describe_mode(const LagrangianPhase& phase, double t, ConstVec u, ConstVec x, EquilibriumStability& stability) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  stability.mode = change_of(phase, PointQuantity::displacement, t, x);
  double most = 0;
  std::size_t at = 0;
  for (std::size_t p = 0; p < phase.points(); ++p) {
    double square = 0;
    for (std::size_t i = 0; i < dim; ++i) square += stability.mode[dim * p + i] * stability.mode[dim * p + i];
    if (square > most) most = square, at = p;
  }
  if (most > 0) {
    for (double& value : stability.mode) value /= std::sqrt(most);
  }
  const std::vector<double> positions = current_positions(phase, t, u);
  const auto first = positions.begin() + static_cast<std::ptrdiff_t>(dim * at);
  stability.largest.assign(first, first + static_cast<std::ptrdiff_t>(dim));
}

// A law of small strains does not feel that a body is lowered as it turns: no weight tips it.
bool can_tip_unfelt(const LagrangianPhase& phase) {
  return phase.info().may_touch && phase.info().of_small_strain && !on_contact_alone(phase).empty();
}

// True if the points have fewer strains than the body has unknowns, so that K is singular.
bool has_too_few_points(const LagrangianPhase& phase) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  const std::size_t strains =
      dim * (dim + 1) / 2 + (phase.info().gradient_components > phase.dim() * phase.dim() ? 1 : 0);
  return phase.points() * strains < phase.size();
}

// unstable_mode.csv: position and mode of each point.
void write_mode(const EquilibriumStability& stability, const LagrangianPhase& phase, double t, ConstVec u,
                const std::filesystem::path& folder) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  const std::vector<double> position = current_positions(phase, t, u);
  const std::vector<std::string> axes = axis_names(phase.dim());
  std::string text = fmt::format("point,{},{}\n", fmt::join(axes, ","), fmt::join(component_names("mode", axes), ","));
  for (std::size_t p = 0; p < phase.points(); ++p) {
    const auto row = [&](const std::vector<double>& values) { return ConstVec(values).subspan(dim * p, dim); };
    text +=
        fmt::format("{},{:.17g},{:.17g}\n", p + 1, fmt::join(row(position), ","), fmt::join(row(stability.mode), ","));
  }
  if (!folder.empty()) write_file(folder / "unstable_mode.csv", text);
}

}  // namespace

EquilibriumStability stability_of(const LagrangianPhase& phase, double t, ConstVec u, double residual) {
  using Kind = EquilibriumStability::Kind;
  const bool can_change = phase.info().nonlinear && !phase.info().remembers && !phase.contact();
  if (!can_change || phase.size() == 0 || phase.size() > direct_solver_limit || slips(phase, t, u)) return {};
  const SparseMatrix K = phase.tangents().matrix(Tangent::consistent, t, u) - phase.tangents().of_loads(t, u);
  const SparseMatrix transposed = K.transpose();
  // With an unsymmetric K no mode grows in one direction if the symmetric part is positive definite.
  LowestMode lowest = lowest_mode(0.5 * (K + transposed), phase.mass(),
                                  [&](const std::vector<double>& x) { return moves_no_material(phase, t, x); });
  if (lowest.positive_definite)
    return {.kind = can_tip_unfelt(phase) ? Kind::not_tested : Kind::stable, .mode = {}, .largest = {}};
  if (!lowest.found) return {};
  constexpr double rounding = 1e-10;
  const bool symmetric = (K - transposed).norm() <= rounding * K.norm();
  if (!symmetric && !find_real_mode(K, phase.mass(), lowest)) return {};

  constexpr double margin = 10;
  const double unsure = std::max(lowest.rounding, margin * residual * stress_part(phase, t, u, lowest.x));
  EquilibriumStability stability{.omega_squared = lowest.omega_squared, .mode = {}, .largest = {}};
  stability.kind = lowest.omega_squared < -unsure  ? Kind::unstable
                   : lowest.omega_squared > unsure ? Kind::stable
                                                   : Kind::neutral;
  if (stability.kind == Kind::stable && can_tip_unfelt(phase)) return {};
  if (stability.kind != Kind::stable) describe_mode(phase, t, u, lowest.x, stability);
  return stability;
}

std::string description(const EquilibriumStability& stability) {
  const std::string where = fmt::format("({:.6g})", fmt::join(stability.largest, ", "));
  if (stability.kind == EquilibriumStability::Kind::neutral) {
    return fmt::format(
        "the equilibrium is neutral, K(u) has the eigenvalue omega^2 = {:.2g}: nothing holds the body against a motion "
        "that is largest at {}; there is no support for it, or too few material points for the basis",
        stability.omega_squared, where);
  }
  return fmt::format(
      "the equilibrium is unstable, K(u) has the eigenvalue omega^2 = {:.6g} < 0: a disturbance grows e-fold in {:.3g} "
      "s, most of all at {}; a small force or initial.u along that mode leads to another equilibrium",
      stability.omega_squared, 1 / std::sqrt(-stability.omega_squared), where);
}

void StabilityTest::confirm(RunState& run, Verdict& verdict) {
  const Model& model = run.model;
  const LagrangianPhase& phase = *model.phase;
  try {
    const StopScope scope(run.asks_to_end());
    stability_ = stability_of(phase, run.t, run.motion->u(), run.measured.last().residual);
  } catch (const Stopped&) {
    verdict = run.end_request.verdict("before it was known whether the equilibrium is stable, after " + verdict.reason);
    return;
  }
  if (stability_.kind == EquilibriumStability::Kind::not_tested)
    if (std::string note = note_on_small_contact(run.scene, phase, run.t, run.motion->u()); !note.empty())
      run.model.notes.push_back(std::move(note));
  const bool neutral = stability_.kind == EquilibriumStability::Kind::neutral;
  // A body that was held and is no more has softened away: what is left of its error bound certifies nothing.
  const bool softened_away = neutral && run.measured.has_distance() && !run.measured.distance_to_go();
  if (neutral && !softened_away) run.model.notes.push_back(description(stability_));
  // Linear ways to rest from u = 0 never enter a null space that the load does not drive.
  const bool is_local = !model.static_method && model.damping->is_local();
  const bool strays = is_local || (neutral && phase.info().nonlinear);
  const bool has_hourglasses = hourglass_note(run.scene).has_value();
  if (strays && !phase.info().remembers && (has_hourglasses || has_too_few_points(phase))) {
    verdict = {RunStatus::step_limit,
               fmt::format("no equilibrium: with {} the grid moves in ways that strain no point{}, which nothing "
                           "resists, and how far the body goes along them is by chance where strains are large or "
                           "damping is local; expected {}; it ended with {}",
                           has_hourglasses ? "one material point a cell" : "so few material points",
                           has_hourglasses ? ", hourglass motions" : "",
                           has_hourglasses ? "points_per_cell = 8" : "more material points per cell", verdict.reason)};
    return;
  }
  if (stability_.kind != EquilibriumStability::Kind::unstable && !softened_away) return;
  verdict = {RunStatus::unstable_equilibrium, fmt::format("{}; {}", verdict.reason, description(stability_))};
  if (run.options.records && !run.options.out.empty())
    write_mode(stability_, phase, run.t, run.motion->u(), own_folder(run.options));
}

void StabilityTest::fill_state(Summary& summary, RunState&) {
  static constexpr std::array names{"", "stable", "neutral", "unstable"};  // in the order of the kinds
  summary.stability = names[static_cast<std::size_t>(stability_.kind)];
  if (stability_.kind == EquilibriumStability::Kind::unstable)
    summary.unstable_omega_squared = stability_.omega_squared;
}

}  // namespace stillpoint

#include "simulation/advice/notes.hpp"

#include <stillpoint/damping.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "geometry/polygon.hpp"
#include "plan/catalogue.hpp"
#include "scene/dimensions.hpp"
#include "scene/grid_lines.hpp"
#include "space/grid/basis.hpp"

namespace stillpoint {
namespace {

// A function that a loaded surface has just come into is loaded by its value there, and resisted by its gradient at the
// nearest point alone: that point's stress takes what makes the two agree. If a point crosses a line of the grid its
// share of a linear function's gradient changes sign: what an elastic body settles over many phases comes out too large
// [Steffen, Kirby and Berzins 2008]. In a stiff body that turns without damping the same jumps of the force give energy
// to what apic's points keep, in the end without bound: twice as much after a turn of hard/spinning_square.toml with E
// = 1e5.
std::vector<std::string> phase_notes(const Problem& problem, const LagrangianPhase& phase) {
  std::vector<std::string> notes;
  const bool ends = problem.phase.ends_by_motion() || problem.phase.max_strain;  // more often than at stages
  if (!phase.info().updated_lagrangian || !ends) return notes;
  if (!phase.info().remembers && problem.phase.quadrature == Quadrature::points &&
      !(problem.tractions.empty() && problem.forces.empty())) {
    notes.emplace_back(
        "where a loaded surface comes to cut cells the points next to it take a stress that is off by up to a quarter, "
        "and an elastic body's displacement by a few per cent: expected boxes of uniform points with "
        "phase.quadrature = \"domains\", or a single phase");
  }
  if (problem.grid.basis != BasisKind::linear) return notes;
  if (!phase.info().remembers && problem.phase.quadrature == Quadrature::points) {
    notes.emplace_back(
        "points cross the cells of a linear basis from phase to phase, which lets an elastic column settle 6 to 9 % "
        "too far; a quadratic basis is within 0.3 %");
  }
  if (problem.phase.transfer == Transfer::apic && is_undamped(problem.damping.strategy)) {
    notes.emplace_back(
        "apic on a linear basis can gain energy without end where nothing damps; a quadratic basis gains none");
  }
  return notes;
}

std::vector<std::string> support_notes(const Problem& problem) {
  std::vector<std::string> notes;
  for (std::size_t k = 0; k < problem.supports.size(); ++k) {
    for (std::size_t d = 0; d < problem.supports[k].at.size(); ++d) {
      const double at = problem.supports[k].at[d];
      const bool inside = std::ranges::any_of(problem.bodies, [&](const BodySpec& body) {
        return body.file.empty() ? at >= body.min[d] && at <= body.max[d] : true;
      });
      if (inside) continue;
      notes.push_back(fmt::format(
          "support[{}] at {:.6g} lies outside the body: it holds the cell that the body shares with it", k, at));
    }
  }
  return notes;
}

// Local damping takes energy from a mass that moves by its own force alone. M⁻¹ of a consistent mass lets what it does
// at one node move the others: blocks of quadratic and cubic cells were seen to diverge at 0.74 of the critical step
// (one-sided, α = 0.8), bars and linear cells at none below it.
std::vector<std::string> damping_notes(const Problem& problem, const LagrangianPhase& phase) {
  const StrategyInfo* strategy = catalogue().strategy(problem.damping.strategy);
  if (!strategy || !strategy->is_local || phase.mass().is_lumped() || problem.dim == 1 ||
      degree_of(problem.grid.basis) == 1)
    return {};
  return {
      fmt::format("damping.strategy = \"{}\" acts at each node by itself, and a consistent mass couples them: on this "
                  "basis no step is known to be stable; expected mass.kind = \"lumped\", or viscous damping",
                  problem.damping.strategy)};
}

// A border feels contact at two places in a cell, along each of its directions: what is narrower than their distance
// goes in between.
std::vector<std::string> thin_rigid_notes(const Problem& problem) {
  std::vector<std::string> notes;
  for (const RigidSpec& rigid : problem.rigid) {
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < rigid.min.size(); ++d) width = std::min(width, rigid.max[d] - rigid.min[d]);
    if (!rigid.polygon.empty()) {
      Polygon corners;
      for (const std::vector<double>& corner : rigid.polygon) corners.push_back({corner[0], corner[1]});
      width = thinnest_part(corners);
    }
    if (!rigid.disc.empty() || !rigid.sphere.empty() || !rigid.cylinder.empty()) width = 2 * rigid.radius;
    const double cells = width / mean_cell(problem.grid);
    if (!(cells < 1)) continue;
    notes.push_back(
        fmt::format("the rigid body '{}' is {:.2g} cells wide{}: it may go in between the places of a border that feel "
                    "contact, two in a cell, and ground that flows around it may go through; expected smaller cells",
                    rigid.name, cells, rigid.polygon.empty() ? "" : " where it is thinnest"));
  }
  return notes;
}

}  // namespace

// ½ Σ_p m_p |x(x_p)|² beside ½ xᵀMx. A lumped mass gives a function that is steep in a sliver more inertia than the
// material that it moves has; a cubic one or Hermite's also in a corner of the body.
double share_in_material(const Problem& problem, const LagrangianPhase& phase, ConstVec x) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  const std::vector<double> nothing(x.size(), 0.0), mass = phase.fields().point_data().masses;
  std::vector<double> of_points(dim * phase.points()), of_supports(of_points.size()), Mx(x.size());
  phase.fields().point_velocity(0, x, of_points);
  phase.fields().point_velocity(0, nothing, of_supports);
  double material = 0, nodes = 0;
  for (std::size_t i = 0; i < of_points.size(); ++i) {
    const double v = of_points[i] - of_supports[i];
    material += problem.mass.factor * mass[i / dim] * v * v;
  }
  phase.mass().apply(x, Mx);
  for (std::size_t i = 0; i < x.size(); ++i) nodes += x[i] * Mx[i];
  return material / nodes;
}

std::string lowest_mode_note(double omega_1, double share) {
  return fmt::format(
      "omega_1 = {:.6g} is that of functions which hardly reach the body, with {:.1g} of their kinetic energy in it: "
      "critical damping is too weak by as much; expected a grid that ends with the body, a finer one, a quadratic "
      "basis or mass.kind = \"consistent\"",
      omega_1, share);
}

// A point in the middle of an eight-noded cell is strained by none of its 12 hourglass motions. In the plane, where a
// cell has two of them, one side that is held rules them out, and one point a cell is a remedy against locking.
std::optional<std::string> hourglass_note(const Problem& problem) {
  if (problem.dim != 3 || problem.grid.basis != BasisKind::linear) return std::nullopt;
  const bool one_a_cell = std::ranges::any_of(problem.bodies, [](const BodySpec& body) {
    return body.file.empty() && std::ranges::all_of(body.points_per_cell, [](int along) { return along == 1; });
  });
  if (!one_a_cell) return std::nullopt;
  return "one material point a cell lets the cells of a linear basis move in hourglass motions that strain no point: "
         "an "
         "answer is the one in which these have no part, and it bends too easily; expected points_per_cell = 8";
}

// Where strength falls, flow gathers in bands as wide as a cell, in which it falls after the less displacement the
// narrower they are.
std::vector<std::string> ground_notes(const Problem& problem) {
  std::vector<std::string> notes;
  for (const auto& [name, material] : problem.materials) {
    const auto value = [&parameters = material.parameters](const char* key) {
      const auto found = parameters.find(key);
      return found == parameters.end() ? 0 : found->second;
    };
    bool falls =
        value("softening_strain") > 0 && (value("c_residual") < value("c") || value("phi_residual") < value("phi"));
    bool dilates = value("psi") > 0;
    StrengthRow before{.plastic_strain = 0, .c = value("c"), .phi = value("phi"), .psi = value("psi")};
    for (const StrengthRow& row : material.softening) {
      falls = falls || row.c < before.c || row.phi < before.phi;
      dilates = dilates || row.psi > 0;
      before = row;
    }
    const bool is_used = std::ranges::find(problem.bodies, name, &BodySpec::material) != problem.bodies.end();
    if (falls && is_used && !material.softening_length)
      notes.push_back(fmt::format(
          "{} softens, and flow gathers in bands as wide as a cell: what comes out depends on the grid; expected "
          "material.{}.softening_length, the width of the bands to which its plastic strains belong",
          name, name));
    if (material.undrained && dilates && is_used)
      notes.push_back(fmt::format(
          "{} dilates though no water flows: the water that it draws apart presses its grains together, and it becomes "
          "stronger without end; no limit load or factor of safety of it is one of the ground",
          name));
  }
  return notes;
}

std::vector<std::string> accuracy_notes(const Problem& problem, const LagrangianPhase& phase, MassScaling scaling) {
  std::vector<std::string> notes = quadrature_notes(problem, phase, scaling);
  std::ranges::move(support_notes(problem), std::back_inserter(notes));
  std::ranges::move(phase_notes(problem, phase), std::back_inserter(notes));
  std::ranges::move(damping_notes(problem, phase), std::back_inserter(notes));
  std::ranges::move(ground_notes(problem), std::back_inserter(notes));
  std::ranges::move(thin_rigid_notes(problem), std::back_inserter(notes));
  if (std::optional<std::string> note = locking_note(problem)) notes.push_back(std::move(*note));
  if (std::optional<std::string> note = slender_cells_note(problem)) notes.push_back(std::move(*note));
  if (std::optional<std::string> note = hourglass_note(problem)) notes.push_back(std::move(*note));
  if (std::optional<std::string> note = uneven_points_note(problem, phase)) notes.push_back(std::move(*note));
  return notes;
}

// The slowest mode dies out like e^{−s t},  s² − c s + ω₁² = 0.
std::optional<std::string> slow_damping_note(const Problem& problem, double c, double omega_1, double step) {
  if (!problem.stop.wants_equilibrium() || !(c > 0) || !(omega_1 > 0) || !(step > 0)) return std::nullopt;
  const double half = c / 2;
  const double slowest =
      half <= omega_1 ? half : omega_1 / half * omega_1 / (1 + std::sqrt((1 - omega_1 / half) * (1 + omega_1 / half)));
  constexpr double usual = 1e-6;  // if only the distance is asked for
  const double time = -std::log(problem.stop.residual > 0 ? std::min(problem.stop.residual, 0.5) : usual) / slowest;
  const double steps = time / step;
  std::string limit;
  if (problem.stop.time > 0 && time > problem.stop.time)
    limit = fmt::format("stop.time is {:.6g} s", problem.stop.time);
  if (problem.stop.steps > 0 && steps > static_cast<double>(problem.stop.steps))
    limit = fmt::format("stop.steps is {}", problem.stop.steps);
  if (limit.empty()) return std::nullopt;
  return fmt::format(
      "damping.c = {:.4g} is {:.2g} times the critical damping: the body would come to rest in {:.2g} s or {:.2g} "
      "steps, "
      "and {}; expected damping.c = \"critical\"",
      c, half / omega_1, time, steps, limit);
}

// Positions keep what a phase moved a point by to their own rounding; strains are carried on by themselves.
std::optional<std::string> lost_motion_note(const LagrangianPhase& phase, double t, ConstVec u, long phases) {
  if (phases < 2) return std::nullopt;
  constexpr double digits = 1e6;  // that a displacement should have at least
  const auto largest = [](const std::vector<double>& values) {
    double most = 0;
    for (const double x : values) most = std::max(most, std::abs(x));
    return most;
  };
  std::vector<double> moved(static_cast<std::size_t>(phase.dim()) * phase.points()),
      stress(static_cast<std::size_t>(phase.info().stress_components) * phase.points());
  phase.fields().point_field(PointQuantity::displacement, t, u, moved);
  const double most = largest(moved);
  const double rounding = std::numeric_limits<double>::epsilon() * largest(phase.fields().point_data().positions);
  if (!(most < digits * rounding)) return std::nullopt;
  phase.fields().point_stress(t, u, stress);
  if (largest(stress) == 0) return std::nullopt;  // nothing acts
  return fmt::format(
      "the points moved by {:.2g} m at most, and their positions are rounded to {:.1g} m from phase to phase: the "
      "displacements are not resolved; expected larger loads or a single phase",
      most, rounding);
}

std::optional<std::string> distance_note(RunStatus status, std::optional<double> distance) {
  constexpr double large = 0.01;
  if (status != RunStatus::equilibrium || !distance || *distance <= large) return std::nullopt;
  return fmt::format("the displacement may be off by {:.2g} of itself, by the lowest frequency: expected stop.distance",
                     *distance);
}

}  // namespace stillpoint

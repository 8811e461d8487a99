#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/loads/formula_samples.hpp"

namespace stillpoint {
namespace {

using Notes = std::vector<std::string>;

// Tells if a load, one of `of`, is zero at all positions until stop.time; empty if that is not known, as it would take
// too long to see or the load has no end.
std::optional<bool> is_zero(const Problem& problem, const Expression& formula, const std::vector<double>& positions,
                            std::size_t of) {
  const auto dim = static_cast<std::size_t>(problem.dim);
  const bool varies = formula.uses('t');
  if (varies && !(problem.stop.time > 0)) return std::nullopt;
  const std::size_t places = formula.uses_position() ? positions.size() / dim : 1;
  const std::size_t most = 2'000'000 / std::max<std::size_t>(1, of / 100);
  constexpr std::size_t most_moments = 20'000, fewest_moments = 200;
  const std::size_t moments = varies ? std::min(most_moments, most / places) : 1;
  const bool thoroughly = !varies || moments >= fewest_moments;
  for (std::size_t p = 0; p < places; ++p) {
    const ConstVec x = formula.uses_position() ? ConstVec(positions).subspan(dim * p, dim) : ConstVec();
    for (std::size_t k = 0; k < std::max<std::size_t>(1, moments); ++k) {
      const double t = varies ? problem.stop.time * static_cast<double>(k + 1) / static_cast<double>(moments + 1) : 0;
      if (formula(x, t) != 0) return false;
    }
  }
  if (varies) {  // a pulse between these moments
    constexpr std::size_t most_places = 8;
    for (std::size_t p = 0; p < std::min(places, most_places); ++p) {
      const ConstVec x = formula.uses_position() ? ConstVec(positions).subspan(dim * p, dim) : ConstVec();
      const std::vector<double> times = moments_of_change(formula, x, 200, problem.stop.time);
      if (std::ranges::any_of(times, [&](double t) { return formula(x, t) != 0; })) return false;
    }
  }
  return thoroughly ? std::optional(true) : std::nullopt;
}

struct Load {
  std::string key;
  std::span<const Expression> components;
};

std::vector<Load> loads_of(const Problem& problem) {
  std::vector<Load> loads;
  for (std::size_t k = 0; k < problem.forces.size(); ++k)
    loads.push_back({fmt::format("force[{}]", k), problem.forces[k].value});
  for (std::size_t k = 0; k < problem.tractions.size(); ++k) {
    loads.push_back({fmt::format("traction[{}]", k), problem.tractions[k].formulas()});
  }
  if (!problem.body_force.empty()) loads.push_back({"body_force", problem.body_force});
  return loads;
}

// A problem is still if no support, wall or rigid body moves or is displaced, and nothing moves, is deformed or bears a
// stress at the start: that of [initial] may be out of balance, and so may that of another run.
bool is_still(const Problem& problem) {
  const auto stays = [](const auto& held) { return held.motion.constant() && held.motion({}, 0) == 0; };
  const auto is_zero = [](const Expression& motion) { return motion.constant() && motion({}, 0) == 0; };
  const auto rests = [&](const RigidSpec& rigid) {
    return !rigid.free && std::ranges::all_of(rigid.motion, is_zero) && std::ranges::all_of(rigid.rotation, is_zero);
  };
  return std::ranges::all_of(problem.supports, stays) && std::ranges::all_of(problem.walls, stays) &&
         std::ranges::all_of(problem.rigid, rests) && problem.initial_u.empty() && problem.initial_v.empty() &&
         problem.initial_stress.empty() && !problem.geostatic && problem.initial_from.empty();
}

void note_loads(const Problem& problem, const LagrangianPhase& phase, ConstVec u, Notes& notes) {
  const std::vector<Load> loads = loads_of(problem);
  constexpr std::size_t most_told = 20;
  std::size_t zeros = 0;
  bool some_act = !problem.own_load.empty();  // for all that is known
  for (const auto& [key, components] : loads) {
    const std::vector<double> positions = std::ranges::any_of(components, &Expression::uses_position)
                                              ? formula_positions(problem, phase, key)
                                              : std::vector<double>();
    const bool zero = std::ranges::all_of(components, [&](const Expression& component) {
      return is_zero(problem, component, positions, loads.size()).value_or(false);
    });
    zeros += zero;
    if (zero && zeros <= most_told)
      notes.push_back(fmt::format("{} is zero{}{}: it loads nothing", key,
                                  key == "body_force" ? " at every material point" : "",
                                  problem.stop.time > 0 ? ", all the time" : ""));
    some_act = some_act || !zero;
  }
  if (zeros > most_told) notes.push_back(fmt::format("so are {} loads more", zeros - most_told));
  const bool pushes = problem.may_touch() && phase.supports().are_touched(0, u);
  if (!some_act && !pushes && is_still(problem))
    notes.emplace_back("no load acts and nothing moves: the body stays as it is");
  if (!some_act || loads_vary(problem) || problem.load) return;
  std::vector<double> F(phase.size());
  phase.external_force(0, u, F);
  if (std::ranges::all_of(F, [](double force) { return force == 0; }))
    notes.emplace_back("all loads act where supports hold the body: nothing is deformed by them");
}

void note_supports(const Problem& problem, Notes& notes) {
  for (std::size_t k = 0; k < problem.supports.size(); ++k) {
    if (!problem.supports[k].face) continue;
    const Face face = *problem.supports[k].face;
    const auto axis = static_cast<std::size_t>(axis_of(face));
    const double h = cell_length_at(problem.grid, axis, (is_upper(face) ? problem.grid.max : problem.grid.min)[axis]);
    const bool reached = std::ranges::any_of(problem.bodies, [&](const BodySpec& body) {
      return is_upper(face) ? body.max[axis] > problem.grid.max[axis] - h : body.min[axis] < problem.grid.min[axis] + h;
    });
    if (!reached) notes.push_back(fmt::format("support[{}] holds nothing: no material is in the cells at its face", k));
  }
}

// A force along an axis may be borne if a wall stands or rubs against it, if a rigid body is in its way, or if the body
// moves on to a support.
bool may_be_borne(const Problem& problem, const LagrangianPhase& phase, int axis, double force) {
  const auto supports = [&](const SupportSpec& support) {
    return support.component == axis || !support.holds_one_component();
  };
  if (problem.may_touch()) return true;
  if (phase.info().updated_lagrangian && std::ranges::any_of(problem.supports, supports)) return true;
  return std::ranges::any_of(problem.walls, [&](const WallSpec& wall) {
    return axis_of(wall.face) == axis ? is_upper(wall.face) == (force > 0) : wall.friction > 0;
  });
}

// Σ F_k over the unknowns of a part; 0 if it is rounding.
double resultant(const FreePart& part, ConstVec F) {
  constexpr double rounding = 1e-9;
  double sum = 0, scale = 0;
  for (const std::size_t k : part.unknowns) {
    sum += F[k];
    scale += std::abs(F[k]);
  }
  return std::abs(sum) > rounding * scale ? sum : 0;
}

// The loads that stay: those at stop.time, or those of a run without an end once all ramps have ended; none if they
// never stay.
std::optional<std::vector<double>> loads_at_end(const Problem& problem, const LagrangianPhase& phase, ConstVec u) {
  constexpr double late = 1e6;  // [s]: longer than any ramp of a run without an end
  std::vector<double> F(phase.size());
  const bool varies = loads_vary(problem), ends = problem.stop.time > 0;
  phase.external_force(varies ? (ends ? problem.stop.time : late) : 0, u, F);
  if (!varies || ends) return F;
  std::vector<double> later(phase.size());
  phase.external_force(1.37 * late, u, later);
  const bool stay = F == later && std::ranges::all_of(F, [](double force) { return std::isfinite(force); });
  return stay ? std::optional(F) : std::nullopt;
}

void note_free_parts(const Problem& problem, const LagrangianPhase& phase, ConstVec u, Notes& notes) {
  if (!problem.stop.wants_equilibrium()) return;
  const std::optional<std::vector<double>> at_end = loads_at_end(problem, phase, u);
  if (!at_end) return;
  const std::vector<double>& F = *at_end;
  std::vector<std::string> balanced;
  for (const FreePart& part : phase.shape().free_parts()) {
    const std::string along = fmt::format(
        "{} along {}",
        part.is_whole ? "the body" : fmt::format("the part of the body around material point {}", part.point + 1),
        (problem.state == StressState::axisymmetric ? "rz" : "xyz")[part.axis]);
    const double force = resultant(part, F);
    if (force == 0) {
      balanced.push_back(along);
    } else if (!may_be_borne(problem, phase, part.axis, force)) {
      throw_scene_error(
          "support",
          fmt::format("nothing holds {}, where its loads add up to {:.4g} N: it falls freely and is never at rest; "
                      "expected a support, loads that balance, or stop.residual = 0 and stop.time",
                      along, force));
    }
  }
  if (!problem.walls.empty() || problem.may_touch()) return;  // that may hold it
  constexpr std::size_t most_told = 4;
  for (std::size_t k = 0; k < balanced.size(); ++k) {
    if (k == most_told) {
      notes.push_back(fmt::format("nor {} other parts of the body", balanced.size() - k));
      break;
    }
    notes.push_back(fmt::format("nothing holds {}: its loads balance, and where it comes to rest is left to the motion",
                                balanced[k]));
  }
}

}  // namespace

std::vector<std::string> load_notes(const Problem& problem, const LagrangianPhase& phase, ConstVec u) {
  Notes notes;
  note_loads(problem, phase, u, notes);
  note_supports(problem, notes);
  note_free_parts(problem, phase, u, notes);
  return notes;
}

}  // namespace stillpoint

// The traces that a violent way to rest in many phases leaves in the points: stresses and positions that no function of
// the grid feels, and that no motion after it takes away.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/grid_lines.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

// The number of cells at a wall that have the length of a way.
double in_cells(const Problem& problem, const WallReaction& reaction, double way) {
  const auto wall = std::ranges::find(problem.walls, reaction.name, &WallSpec::name);
  const bool is_above = wall != problem.walls.end() && is_upper(wall->face);
  const auto axis = static_cast<std::size_t>(reaction.axis);
  return way / cell_length_at(problem.grid, axis, (is_above ? problem.grid.max : problem.grid.min)[axis]);
}

// A note for each wall that was to move faster than a body follows: how far it has been behind.
std::vector<std::string> notes_on_late_walls(const Problem& problem, const std::vector<WallReaction>& walls) {
  std::vector<std::string> notes;
  for (const WallReaction& wall : walls) {
    if (wall.furthest_behind == 0) continue;
    notes.push_back(fmt::format(
        "the wall '{}' was to move by {:.4g} m ({:.2g} cells) at once: in phases it comes there within many steps; "
        "expected a motion that takes some time",
        wall.name, wall.furthest_behind, in_cells(problem, wall, wall.furthest_behind)));
  }
  return notes;
}

// Why a body that a wall has pushed is in no equilibrium that could be trusted; empty: no wall has. Jumps of a tenth of
// a cell have left 0.1 to 0.9 % of the settlement, jumps of a fifth up to 250 %.
std::string fault_of_push(const Problem& problem, const std::vector<WallReaction>& walls) {
  constexpr double largest_push = 0.1;  // [cells]
  for (const WallReaction& wall : walls) {
    const double cells = in_cells(problem, wall, wall.put_back);
    if (!(cells > largest_push)) continue;
    return fmt::format(
        "the wall '{}' has pushed out at once what lay in it, or flew into it within a step, by {:.4g} m ({:.2g} "
        "cells): points that jump so far keep stresses and places that no function of the grid feels; expected initial "
        "values outside the wall, a slower motion, or a single phase",
        wall.name, wall.put_back, cells);
  }
  return "";
}

// A note on the share of the stresses that the grid does not feel; empty: there is nothing to say. If points yield or
// part, their stresses vary as fast as they like.
std::string null_space_note(const Problem& problem, const LagrangianPhase& phase, double null_space_stress) {
  constexpr double negligible = 0.05;
  if (phase.info().remembers || null_space_stress <= negligible) return "";
  const char* remedy = problem.grid.basis == BasisKind::linear ? "take a quadratic basis"
                       : problem.phase.deformation == DeformationRule::accumulated
                           ? "take phase.deformation = \"positions\""
                           : "take more points per cell or smaller cells";
  return fmt::format("{:.2g} of the points' stresses varies faster than the grid's functions, which do not feel it: {}",
                     null_space_stress, remedy);
}

// A note if the parts that were to rest cannot; empty: they may.
std::string note_on_rest(const RestFigures& rest) {
  if (rest.may_rest) return "";
  return "phase.rest lets nothing rest while a load or the place of a spring is a formula of t, a pressure follows the "
         "body, or a stage comes on; expected loads that stay what they are";
}

class LeftInPoints : public Watcher {
 public:
  /// Takes an equilibrium back if a wall has pushed a part of the body out of itself at once, by a good part of a cell;
  /// doubts it if much of the stresses is not felt by the grid.
  void confirm(RunState& run, Verdict& verdict) override {
    const LagrangianPhase& phase = *run.model.phase;
    if (!phase.info().updated_lagrangian) return;
    if (const std::string fault = fault_of_push(run.scene, phase.supports().wall_reactions(run.t)); !fault.empty()) {
      verdict = {RunStatus::step_limit, fmt::format("no equilibrium: {}; it ended with {}", fault, verdict.reason)};
      return;
    }
    if (phase.info().remembers) return;
    const double unfelt = phase.fields().null_space_stress(run.t, run.motion->u());
    if (const std::string note = null_space_note(run.scene, phase, unfelt); !note.empty())
      verdict.reason += "; but " + note;
  }
  void fill_state(Summary& summary, RunState& run) override {
    LagrangianPhase& phase = *run.model.phase;
    if (!phase.info().updated_lagrangian) return;
    for (const std::string& note : notes_on_late_walls(run.scene, phase.supports().wall_reactions(run.t)))
      add_note(summary, note);
    const auto transfer = phase.control().transfer_errors();
    summary.mass_error = transfer.mass;
    summary.momentum_error = transfer.momentum;
    summary.angular_momentum_error = transfer.angular_momentum;
    summary.added_mass = transfer.added_mass;
    if (run.scene.phase.rest > 0) {
      run.motion->evaluate(run.t);
      const RestFigures rest = phase.control().rest_figures(run.t, run.motion->system.last().trial->reactions);
      summary.resting_points = rest.points;
      summary.held_force = rest.held_force;
      add_note(summary, note_on_rest(rest));
    }
    summary.null_space_stress = phase.fields().null_space_stress(run.t, run.motion->u());
    add_note(summary, null_space_note(run.scene, phase, *summary.null_space_stress));
    add_note(summary, lost_motion_note(phase, run.t, run.motion->u(), run.phases));
  }
};

}  // namespace

std::unique_ptr<Watcher> watch_left_in_points() { return std::make_unique<LeftInPoints>(); }

}  // namespace stillpoint

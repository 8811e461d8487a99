#include "simulation/left_in_points.hpp"

#include <fmt/format.h>

namespace stillpoint {
namespace {

double in_cells(const Problem& problem, const WallReaction& wall, double way) {
  return way / problem.grid.cell_length(static_cast<std::size_t>(wall.axis));
}

}  // namespace

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

// Jumps of a tenth of a cell have left 0.1 to 0.9 % of the settlement, of a fifth up to 250 %.
std::string fault_of_push(const Problem& problem, const std::vector<WallReaction>& walls) {
  constexpr double far = 0.1;  // of a cell
  for (const WallReaction& wall : walls) {
    const double cells = in_cells(problem, wall, wall.put_back);
    if (!(cells > far)) continue;
    return fmt::format(
        "the wall '{}' has pushed out at once what lay in it, or flew into it within a step, by {:.4g} m ({:.2g} "
        "cells): points that jump so far keep stresses and places that no function of the grid feels; expected initial "
        "values outside the wall, a slower motion, or a single phase",
        wall.name, wall.put_back, cells);
  }
  return "";
}

// Where points yield or part, stresses vary as fast as they like.
std::optional<std::string> null_space_note(const Problem& problem, const LagrangianPhase& phase,
                                           double null_space_stress) {
  constexpr double much = 0.05;
  if (phase.history_dependent() || null_space_stress <= much) return std::nullopt;
  const char* remedy = problem.grid.basis == BasisKind::linear ? "take a quadratic basis"
                       : problem.phase.deformation == DeformationRule::accumulated
                           ? "take phase.deformation = \"positions\""
                           : "take more points per cell or smaller cells";
  return fmt::format("{:.2g} of the points' stresses varies faster than the grid's functions, which do not feel it: {}",
                     null_space_stress, remedy);
}

}  // namespace stillpoint

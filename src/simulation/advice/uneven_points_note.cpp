// Points that another run has moved do not fill the cells of this one's grid as those that are placed in them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "scene/resolve.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/advice/placed_points.hpp"

namespace stillpoint {
namespace {

/// Whether all cells around one have points as well, so that it is inside the body.
bool is_inside(const FilledCells& filled, const FilledCells::key_type& cell, int dim) {
  const std::array<int, 3> reach = {1, dim > 1 ? 1 : 0, dim > 2 ? 1 : 0};
  for (long i = -reach[0]; i <= reach[0]; ++i)
    for (long j = -reach[1]; j <= reach[1]; ++j)
      for (long k = -reach[2]; k <= reach[2]; ++k)
        if (!filled.contains({cell[0] + i, cell[1] + j, cell[2] + k})) return false;
  return true;
}

}  // namespace

std::optional<std::string> uneven_points_note(const Problem& problem, const LagrangianPhase& phase) {
  if (problem.initial_from.empty() || problem.phase.quadrature == Quadrature::domains) return std::nullopt;
  const bool is_linear = problem.grid.basis == BasisKind::linear;
  const double unfelt = is_linear ? 0.1 : 0.3;  // wider functions feel less of it
  const FilledCells filled = filled_cells(problem, phase);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& [cell, share] : filled) {
    if (!is_inside(filled, cell, problem.dim)) continue;
    least = std::min(least, share);
    most = std::max(most, share);
  }
  if (!(std::max(1 - least, most - 1) > unfelt)) return std::nullopt;
  return fmt::format(
      "the points that the other run has moved fill cells inside the body by {:.2g} to {:.2g} of them: what they "
      "integrate is off by about as much from cell to cell, and so is a stress that was in balance there; expected {}",
      least, most,
      why_no_domains(problem).empty() ? "phase.quadrature = \"domains\" in both runs"
      : is_linear                     ? "a quadratic basis, or more points per cell"
                                      : "more points per cell");
}

}  // namespace stillpoint

#include "simulation/advice/placed_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/grid_lines.hpp"

namespace stillpoint {
namespace {

/// What a point takes of its cell at its present position, as a share of the cell.
double share_of_cell(const Problem& problem, std::size_t body, ConstVec x, double volume) {
  double cell = problem.dim < 3 ? problem.bodies[body].area : 1;
  if (problem.state == StressState::axisymmetric) cell = 2 * std::numbers::pi * std::max(x[0], 0.0);
  for (std::size_t d = 0; d < x.size(); ++d) cell *= cell_length_at(problem.grid, d, x[d]);
  return cell > 0 ? volume / cell : 0;
}

}  // namespace

PlacedPoints place_points(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  const auto dim = static_cast<std::size_t>(problem.dim);
  const PointData data = phase.fields().point_data();
  PlacedPoints placed{.dim = dim, .bodies = data.bodies, .x = data.initial_positions, .share = data.volumes};
  std::vector<double> way(placed.x.size());
  phase.fields().point_displacement(t, u, way);
  for (std::size_t k = 0; k < way.size(); ++k) placed.x[k] += way[k];
  phase.fields().point_field(PointQuantity::volume, t, u, placed.share);
  for (std::size_t p = 0; p < placed.share.size(); ++p)
    placed.share[p] = share_of_cell(problem, static_cast<std::size_t>(data.bodies[p]),
                                    ConstVec(placed.x).subspan(dim * p, dim), placed.share[p]);
  return placed;
}

FilledCells filled_cells(const Problem& problem, const LagrangianPhase& phase) {
  const PlacedPoints placed = place_points(problem, phase, 0, std::vector<double>(phase.size(), 0.0));
  FilledCells filled;
  for (std::size_t p = 0; p < placed.bodies.size(); ++p) {
    FilledCells::key_type cell{};
    for (std::size_t d = 0; d < placed.dim; ++d)
      cell[d] = std::lround(std::floor(cells_before(problem.grid, d, placed.x[placed.dim * p + d])));
    filled[cell] += placed.share[p];
  }
  return filled;
}

}  // namespace stillpoint

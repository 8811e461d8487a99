// The grid of a scene, which may follow a wall.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cmath>

#include "space/grid/grid.hpp"

namespace stillpoint {

/// The scene's grid when the followed wall has moved by `moved` [m]: its face lies at the wall, all other lines stay
/// where they were, and columns are added or taken away next to it so that the last one is 0.5 to 1.5 cells wide.
template <int Dim>
Grid<Dim> grid_at(const Problem& problem, double moved) {
  const GridSpec& spec = problem.grid;
  Grid<Dim> grid;
  for (std::size_t d = 0; d < Dim; ++d) grid.axes[d] = Axis::uniform(spec.min[d], spec.max[d], spec.cells[d]);
  const auto wall = std::ranges::find(problem.walls, spec.follow, &WallSpec::name);
  if (spec.follow.empty() || wall == problem.walls.end()) return grid;

  const auto d = static_cast<std::size_t>(axis_of(wall->face));
  const double h = spec.cell_length(d);
  const double length = spec.max[d] - spec.min[d] + (is_upper(wall->face) ? moved : -moved);
  const int cells = std::max(1, static_cast<int>(std::floor(length / h + 0.5)));
  std::vector<double> nodes;
  for (int i = 0; i < cells; ++i) nodes.push_back(i * h);
  nodes.push_back(length);
  if (is_upper(wall->face)) {
    for (double& node : nodes) node += spec.min[d];
  } else {
    for (double& node : nodes) node = spec.max[d] - node;
    std::ranges::reverse(nodes);
  }
  grid.axes[d].nodes = nodes;
  return grid;
}

}  // namespace stillpoint

// The grid of a scene, which may follow a wall.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cmath>

#include "scene/grid_lines.hpp"
#include "space/grid/grid.hpp"

namespace stillpoint {

/// The lines from the far end of an axis, at 0, to a wall at `length` [m]. lines: as they are when the wall is at the
/// last of them.
inline std::vector<double> lines_to_wall(std::vector<double> lines, double length) {
  const double end = lines.back(), h = end - lines[lines.size() - 2];
  const auto is_past = [&](double line) { return line > length - h / 2; };
  lines.erase(std::find_if(lines.begin() + 1, lines.end(), is_past), lines.end());
  while (lines.back() >= end && length - lines.back() > 1.5 * h) lines.push_back(lines.back() + h);
  lines.push_back(length);
  return lines;
}

/// The scene's grid when the followed wall has moved by `moved` [m]: its face lies at the wall, all other lines stay
/// where they were, and columns are added or taken away next to it so that the last one is 0.5 to 1.5 cells wide: of
/// those at the wall in the beginning, or more where the cells behind them were wider.
template <int Dim>
Grid<Dim> grid_at(const Problem& problem, double moved) {
  const GridSpec& spec = problem.grid;
  Grid<Dim> grid;
  for (std::size_t d = 0; d < Dim; ++d) grid.axes[d] = {grid_lines(spec, d), has_equal_cells(spec, d)};
  const auto wall = std::ranges::find(problem.walls, spec.follow, &WallSpec::name);
  if (spec.follow.empty() || wall == problem.walls.end()) return grid;

  const auto d = static_cast<std::size_t>(axis_of(wall->face));
  const double length = spec.max[d] - spec.min[d] + (is_upper(wall->face) ? moved : -moved);
  std::vector<double> nodes;
  if (has_equal_cells(spec, d)) {
    const double h = mean_cell(spec, d);
    const int cells = std::max(1, static_cast<int>(std::floor(length / h + 0.5)));
    for (int i = 0; i < cells; ++i) nodes.push_back(i * h);
    nodes.push_back(length);
  } else {
    for (const double line : grid.axes[d].nodes)
      nodes.push_back(is_upper(wall->face) ? line - spec.min[d] : spec.max[d] - line);
    std::ranges::sort(nodes);
    nodes = lines_to_wall(std::move(nodes), length);
  }
  if (is_upper(wall->face)) {
    for (double& node : nodes) node += spec.min[d];
  } else {
    for (double& node : nodes) node = spec.max[d] - node;
    std::ranges::reverse(nodes);
  }
  grid.axes[d].nodes = std::move(nodes);
  return grid;
}

/// Whether a followed wall has moved by no more than a thousand times the grid's own size, and by a number.
inline bool can_follow(const Problem& problem, double moved) {
  constexpr double largest_share = 1000;
  double size = 0;
  for (std::size_t d = 0; d < problem.grid.max.size(); ++d)
    size = std::max(size, problem.grid.max[d] - problem.grid.min[d]);
  return std::abs(moved) <= largest_share * size;
}

/// The same grid for a displacement that was saved; throws StateError if no run could have followed the wall so far.
template <int Dim>
Grid<Dim> saved_grid_at(const Problem& problem, double moved) {
  if (!can_follow(problem, moved)) throw StateError("its grid has gone too far");
  return grid_at<Dim>(problem, moved);
}

}  // namespace stillpoint

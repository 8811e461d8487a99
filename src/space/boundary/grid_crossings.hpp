// Intersections of a straight part of a border with the grid.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/body_border.hpp"
#include "space/grid/grid.hpp"

namespace stillpoint {

/// The ends of a line and its crossings with grid lines between them, in order.
inline std::vector<Point<2>> grid_crossings(const BorderLine& line, const Grid<2>& grid) {
  constexpr double rounding = 1e-12;  // share of the line's length: no piece is shorter
  std::vector<std::pair<double, Point<2>>> found = {{0, line.from}, {1, line.to}};
  for (std::size_t d = 0; d < 2; ++d) {
    const double length = line.to[d] - line.from[d];
    if (length == 0) continue;
    for (const double node : grid.axes[d].nodes) {
      const double share = (node - line.from[d]) / length;
      if (!(share > rounding && share < 1 - rounding)) continue;
      Point<2> x;
      x[1 - d] = line.from[1 - d] + share * (line.to[1 - d] - line.from[1 - d]);
      x[d] = node;
      found.emplace_back(share, x);
    }
  }
  std::ranges::sort(found, {}, &std::pair<double, Point<2>>::first);
  std::vector<Point<2>> ends = {line.from};
  double last = 0;
  for (const auto& [share, x] : found) {
    if (share - last > rounding) ends.push_back(x), last = share;
  }
  return ends;
}

}  // namespace stillpoint

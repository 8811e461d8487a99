// The shortest side of a cell, in which depths and the frequencies of points are counted.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "space/grid/grid.hpp"

namespace stillpoint {

/// The shortest side of the cell at this position in the grid [m].
template <int Dim>
double shortest_side(const Grid<Dim>& grid, const std::array<int, static_cast<std::size_t>(Dim)>& cell) {
  double side = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const std::vector<double>& nodes = grid.axes[axis].nodes;
    const auto i = static_cast<std::size_t>(cell[axis]);
    side = std::min(side, nodes[i + 1] - nodes[i]);
  }
  return side;
}

}  // namespace stillpoint

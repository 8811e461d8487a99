// The size that a grid is spoken of by.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>

namespace stillpoint {

/// The longest side of the grid's cells at the start [m].
inline double longest_cell(const GridSpec& grid) {
  double longest = 0;
  for (std::size_t d = 0; d < grid.cells.size(); ++d) longest = std::max(longest, grid.cell_length(d));
  return longest;
}

}  // namespace stillpoint

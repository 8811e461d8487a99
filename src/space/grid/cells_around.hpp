// The cells of a grid around one of them.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "space/grid/grid.hpp"

namespace stillpoint {

/// Calls visit(number) for each cell with a number that is no further than `reach` cells away along every axis, in
/// ascending order.
template <int Dim, class Visit>
void for_cells_around(const Grid<Dim>& grid, const std::type_identity_t<std::array<int, Dim>>& here, int reach,
                      const Visit& visit) {
  std::array<int, Dim> low, high;
  for (int d = 0; d < Dim; ++d) {
    low[d] = std::max(here[d] - reach, grid.range(d).first);
    high[d] = std::min(here[d] + reach, grid.range(d).end - 1);
  }
  std::array<int, Dim> cell = low;
  while (cell[Dim - 1] <= high[Dim - 1]) {
    visit(grid.cell_number(cell));
    int d = 0;
    while (++cell[d] > high[d] && d < Dim - 1) {
      cell[d] = low[d];
      ++d;
    }
  }
}

}  // namespace stillpoint

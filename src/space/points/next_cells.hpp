// The cells that material points come to lie in when a phase ends.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "space/points/material_points.hpp"
#include "space/points/point_order.hpp"

namespace stillpoint {

/// From the cells of one grid to those of the next, which has the same lines but next to a wall. Most points stay where
/// they are, and their cell need not be looked for.
template <int Dim>
class NextCells {
 public:
  /// It outlives this.
  explicit NextCells(const Grid<Dim>& next_grid)
      : next_(next_grid), per_length_(PointOrder<Dim>::cells_per_length(next_grid)) {
    for (int d = 0; d < Dim; ++d) {
      lines_[d] = next_.axes[d].nodes.data();
      cells_[d] = next_.axes[d].cells();
    }
  }

  /// cell: the next grid's numbers of the cells at x, for the points of occupied cell k, which is the one at `here`; x,
  /// cell: (points). False if one of them lies outside, and is counted to the cell at the end.
  bool find(const MaterialPoints<Dim>& points, std::size_t k, const std::array<int, Dim>& here,
            const std::array<std::vector<double>, Dim>& x, std::vector<int>& cell) const {
    Point<Dim> low{}, high{};  // of the same cell in the next grid, if there is one
    for (int d = 0; d < Dim; ++d) {
      if (here[d] >= cells_[d]) continue;
      low[d] = lines_[d][here[d]];
      high[d] = lines_[d][here[d] + 1];
    }
    const int same = next_.cell_number(here);
    bool all_inside = true;
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      bool stays = true;
      for (int d = 0; d < Dim; ++d) stays = stays && x[d][p] >= low[d] && x[d][p] < high[d];
      cell[p] = stays ? same : find(x, p, all_inside);
    }
    return all_inside;
  }

 private:
  int find(const std::array<std::vector<double>, Dim>& x, std::size_t p, bool& all_inside) const {
    std::array<int, Dim> cell;
    for (int d = 0; d < Dim; ++d) {
      const Axis& axis = next_.axes[d];
      all_inside = all_inside && x[d][p] >= axis.min() && x[d][p] <= axis.max();
      cell[d] = axis.cell_of(x[d][p], per_length_[d]);
    }
    return next_.cell_number(cell);
  }

  const Grid<Dim>& next_;
  Point<Dim> per_length_;
  std::array<const double*, Dim> lines_;
  std::array<int, Dim> cells_;
};

}  // namespace stillpoint

// The cells of the material points at the end of a phase.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "space/points/material_points.hpp"
#include "space/points/point_order.hpp"

namespace stillpoint {

/// Finds cells in the next grid, whose lines are the same except next to a wall. Most points stay in their cell, which
/// is then known without a search.
template <int Dim>
class NextCells {
 public:
  /// next_grid: must outlive this object.
  explicit NextCells(const Grid<Dim>& next_grid)
      : next_(next_grid), per_length_(PointOrder<Dim>::cells_per_length(next_grid)) {
    for (int d = 0; d < Dim; ++d) {
      lines_[d] = next_.axes[d].nodes.data();
      cells_[d] = next_.axes[d].cells();
    }
  }

  struct Found {
    bool all_inside = true;        // whether all points are inside the grid; others are assigned to its end cells
    bool all_have_numbers = true;  // whether the cells of all of them do; others have none
  };

  /// Sets `cell` to the next grid's numbers of the cells at x, for the points of occupied cell k, which lies at `here`;
  /// x, cell: (points).
  Found find(const MaterialPoints<Dim>& points, std::size_t k, const std::array<int, Dim>& here,
             const std::array<std::vector<double>, Dim>& x, std::vector<int>& cell) const {
    Point<Dim> low{}, high{};  // bounds of the same cell in the next grid, if there is one
    for (int d = 0; d < Dim; ++d) {
      if (here[d] >= cells_[d]) continue;
      low[d] = lines_[d][here[d]];
      high[d] = lines_[d][here[d] + 1];
    }
    const int same = next_.cell_number(here);
    Found found;
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      bool stays = true;
      for (int d = 0; d < Dim; ++d) stays = stays && x[d][p] >= low[d] && x[d][p] < high[d];
      cell[p] = stays ? same : find(x, p, found);
    }
    return found;
  }

 private:
  int find(const std::array<std::vector<double>, Dim>& x, std::size_t p, Found& found) const {
    std::array<int, Dim> cell;
    for (int d = 0; d < Dim; ++d) {
      const Axis& axis = next_.axes[d];
      found.all_inside = found.all_inside && x[d][p] >= axis.min() && x[d][p] <= axis.max();
      cell[d] = axis.cell_of(x[d][p], per_length_[d]);
    }
    found.all_have_numbers = found.all_have_numbers && next_.holds(cell);
    return next_.cell_number(cell);
  }

  const Grid<Dim>& next_;
  Point<Dim> per_length_;
  std::array<const double*, Dim> lines_;
  std::array<int, Dim> cells_;
};

}  // namespace stillpoint

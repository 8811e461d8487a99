// The division of a grid's cells among ranks, with about as many material points for each.
//
// Cells are put in a row, across the axis along which the grid has most of them, so that few of one rank's cells lie
// beside those of another; the row is cut where the points are shared out evenly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/grid/grid.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// How many points a cell holds, by its place in the row.
struct PointsOfCell {
  std::int64_t place = 0, points = 0;
};

template <int Dim>
class RankCells {
 public:
  /// The largest number of points of a rank over the mean before cells are shared out anew.
  static constexpr double most_over_mean = 1.1;

  RankCells() = default;
  RankCells(const Grid<Dim>& grid, int ranks) : ranks_(ranks) {
    for (int d = 0; d < Dim; ++d) cells_[static_cast<std::size_t>(d)] = grid.axes[static_cast<std::size_t>(d)].cells();
    along_ = static_cast<int>(std::ranges::max_element(cells_) - cells_.begin());
  }

  std::int64_t place(const std::array<int, Dim>& cell) const {
    std::int64_t place = cell[static_cast<std::size_t>(along_)];
    for (int d = Dim - 1; d >= 0; --d)
      if (d != along_) place = place * cells_[static_cast<std::size_t>(d)] + cell[static_cast<std::size_t>(d)];
    return place;
  }
  /// The rank that has a cell.
  int owner(const std::array<int, Dim>& cell) const {
    return static_cast<int>(std::ranges::upper_bound(first_, place(cell)) - first_.begin());
  }

  /// Shares out cells by the points that they hold, in any order, of all ranks; a cell may be there more than once.
  void share_out(std::vector<PointsOfCell> cells) {
    std::ranges::sort(cells, {}, &PointsOfCell::place);
    std::int64_t all = 0, before = 0;
    for (const PointsOfCell& cell : cells) all += cell.points;
    first_.clear();
    std::int64_t last_place = -1;
    for (const PointsOfCell& cell : cells) {
      // The middle of the cell's points decides which rank they go to.
      const std::int64_t middle = (2 * before + cell.points) * ranks_ / (2 * std::max<std::int64_t>(all, 1));
      const bool is_same_cell = std::exchange(last_place, cell.place) == cell.place;
      while (!is_same_cell && static_cast<std::int64_t>(first_.size()) < std::min<std::int64_t>(middle, ranks_ - 1))
        first_.push_back(cell.place);
      before += cell.points;
    }
    while (static_cast<int>(first_.size()) + 1 < ranks_) first_.push_back(INT64_MAX);
  }

 private:
  int ranks_ = 1, along_ = 0;
  std::array<int, Dim> cells_{};     // of the grid
  std::vector<std::int64_t> first_;  // the first place of rank 1, of rank 2 …
};

}  // namespace stillpoint

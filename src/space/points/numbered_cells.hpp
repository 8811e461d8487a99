// Which cells of the grid have numbers: those of a box around the bodies, if most of the grid is empty.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "parallel/of_all.hpp"
#include "space/grid/grid.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// Cells around those with points that have numbers as well: the functions there, of a domain's second cell too, the
/// hosts of slivers, and what lies on a border are less than half as far away. The rest is room to move.
inline constexpr int numbered_around = 8;
/// The share of the grid's cells above which a box is not worth it, and all have numbers.
inline constexpr double most_in_box = 0.25;

/// Whether cells may be left without a number when a run begins. What a stage hands on, what is known of parts at rest,
/// and what a grid that follows a wall keeps are by the functions' numbers; where the points of a file are is not known
/// yet.
inline bool may_leave_cells_out(const Problem& problem) {
  const auto is_of_file = [](const BodySpec& body) { return body.shape() == BodyShape::points; };
  return problem.stages.empty() && problem.phase.rest == 0 && problem.grid.follow.empty() && !problem.bodies.empty() &&
         std::ranges::none_of(problem.bodies, is_of_file);
}

template <int Dim>
class NumberedCells {
  using Box = typename Grid<Dim>::Box;

 public:
  /// The grid when a stage begins. carries_on: whether another stage has been before.
  static Grid<Dim> around_shapes(const Problem& problem, Grid<Dim> grid, bool carries_on) {
    if (carries_on || !may_leave_cells_out(problem)) return grid;
    Box occupied = nothing;
    for (const BodySpec& body : problem.bodies) {
      for (std::size_t d = 0; d < Dim; ++d)
        include(occupied[d], {grid.axes[d].cell_of(body.min[d]), grid.axes[d].cell_of(body.max[d]) + 1});
    }
    grid.box = worthwhile(grid, around(grid, occupied, numbered_around));
    return grid;
  }

  /// The numbered cells of the next phase. at: the cells with points in this one, which have moved by `motion` cells at
  /// most; ranks: that have points as well.
  static Box around_points(const Grid<Dim>& grid, const std::vector<std::array<int, Dim>>& at, double motion,
                           const Ranks* ranks = nullptr) {
    if (grid.box == Box{}) return {};  // most of the grid has been occupied
    Box occupied = nothing;
    for (const auto& cell : at) {
      for (std::size_t d = 0; d < Dim; ++d) include(occupied[d], {cell[d], cell[d] + 1});
    }
    if (ranks) include_others(*ranks, occupied);
    const int moved = 1 + static_cast<int>(std::ceil(std::min(motion, 1e6)));
    const Box needed = around(grid, occupied, numbered_around / 2 + moved);
    bool fits = true;
    for (std::size_t d = 0; d < Dim; ++d)
      fits = fits && grid.box[d].first <= needed[d].first && needed[d].end <= grid.box[d].end;
    return fits ? grid.box : worthwhile(grid, around(grid, occupied, numbered_around + moved));
  }

  /// The number in grid `now` of each function of `before`, which has the same lines, −1 if it has none there. Basis:
  /// the TensorBasis; fields: of motion, one after the other.
  template <class Basis>
  static std::vector<int> now_of(const Grid<Dim>& before, const Grid<Dim>& now, int fields) {
    const int of_field = Basis::count(before), of_field_now = Basis::count(now);
    std::vector<int> numbers;
    for (int field = 0; field < fields; ++field) {
      for (int f = 0; f < of_field; ++f) {
        const int number = Basis::number_at(now, Basis::places_of(before, f));
        numbers.push_back(number < 0 ? -1 : field * of_field_now + number);
      }
    }
    return numbers;
  }

 private:
  static constexpr CellRange none{1 << 30, 0};
  static constexpr Box nothing = [] {
    Box box{};
    box.fill(none);
    return box;
  }();

  static void include(CellRange& in, const CellRange& more) {
    in = {std::min(in.first, more.first), std::max(in.end, more.end)};
  }
  static void include_others(const Ranks& ranks, Box& box) {
    std::array<int, 2 * Dim> ends;
    for (std::size_t d = 0; d < Dim; ++d) ends[2 * d] = box[d].first, ends[2 * d + 1] = -box[d].end;
    ranks.smallest(std::span<int>(ends));
    for (std::size_t d = 0; d < Dim; ++d) box[d] = {ends[2 * d], -ends[2 * d + 1]};
  }
  static Box around(const Grid<Dim>& grid, Box box, int by) {
    for (std::size_t d = 0; d < Dim; ++d)
      box[d] = {std::max(box[d].first - by, 0), std::min(box[d].end + by, grid.axes[d].cells())};
    return box;
  }
  // The box, or all cells if it has most of them.
  static Box worthwhile(const Grid<Dim>& grid, const Box& box) {
    double in_box = 1, all = 1;
    for (std::size_t d = 0; d < Dim; ++d) in_box *= box[d].count(), all *= grid.axes[d].cells();
    return in_box <= most_in_box * all ? box : Box{};
  }
};

}  // namespace stillpoint

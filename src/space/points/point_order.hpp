// Keeps the material points sorted by material and cell as they move through the grid.
#pragma once

#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"
#include "base/reordering.hpp"
#include "space/points/material_points.hpp"
#include "space/points/point_domains.hpp"

namespace stillpoint {

/// Calls apply(values) for every array of point data.
template <int Dim, class Apply>
void for_point_arrays(MaterialPoints<Dim>& points, const Apply& apply) {
  for (auto& x : points.x) apply(x);
  for (auto& v : points.v) apply(v);
  for (auto& B : points.B_apic) apply(B);
  for (auto& x : points.corner) apply(x);
  for (auto& r : points.half) apply(r);
  for (auto& X : points.rest) apply(X);
  apply(points.volume);
  apply(points.mass);
  apply(points.number);
}

/// Replaces the points by copies: point k is the former point from[k], with all its data. There may be more points than
/// before.
template <int Dim>
void take_points(MaterialPoints<Dim>& points, const std::vector<int>& from) {
  for_point_arrays(points, [&](auto& values) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> taken(from.size());
    for_each_index(from.size(),
                   [&, of = values.data(), to = taken.data(), at = from.data()](std::size_t k) { to[k] = of[at[k]]; });
    values.swap(taken);
  });
}

template <int Dim>
class PointOrder {
 public:
  /// The largest number of points that are listed as one cell; a fuller cell is listed in parts.
  static constexpr int most_points = 128;

  /// Sorts the points and lists the cells that contain points or, with domains, whose window does.
  void sort(MaterialPoints<Dim>& points, const Grid<Dim>& grid) {
    find_cells(points, grid);
    sort_by_cells(points, grid);
  }
  /// As sort(), if cells() has been set already by the code that moved the points.
  void sort_by_cells(MaterialPoints<Dim>& points, const Grid<Dim>& grid) {
    order_.from().resize(points.size());
    points.cell.clear();
    points.cell_begin.clear();
    for (std::size_t m = 0; m < points.materials(); ++m) {
      sort_material(points, grid.cells(), points.material_begin[m], points.material_begin[m + 1]);
    }
    points.cell_begin.push_back(static_cast<int>(points.size()));
    order_.complete();
    for_point_arrays(points, [this](auto& values) { order_.apply(values, work_of(values)); });
  }
  /// The grid's number of the cell that each point lies in, (points).
  std::vector<int>& cells() { return cell_; }
  /// The reordering of the points by the last sort.
  const Reordering& order() const { return order_; }

  /// The number of cells per length along the axes of a grid, from the first cell: the last may be wider or narrower,
  /// next to a wall that the grid follows [1/m].
  static Point<Dim> cells_per_length(const Grid<Dim>& grid) {
    Point<Dim> per_length;
    for (int d = 0; d < Dim; ++d) per_length[d] = 1 / (grid.axes[d].nodes[1] - grid.axes[d].nodes[0]);
    return per_length;
  }

 private:
  void find_cells(MaterialPoints<Dim>& points, const Grid<Dim>& grid) {
    cell_.resize(points.size());
    const Point<Dim> per_length = cells_per_length(grid);
    if (points.has_domains()) points.widest = widest_domain(grid);
    for_each_index(points.size(), [&](std::size_t p) {
      std::array<int, Dim> cell;
      if (points.has_domains()) {
        cell = window_of(Domain<Dim>::in_grid(points, p, grid), grid);
        if (!grid.holds(cell)) throw std::logic_error("a domain is outside the cells that have numbers");
      } else {
        for (int d = 0; d < Dim; ++d) cell[d] = grid.axes[d].cell_of(points.x[d][p], per_length[d]);
      }
      cell_[p] = grid.cell_number(cell);
    });
  }
  // A stable counting sort, which also lists the cells with their first points. Successive points in one cell, as most
  // are, are taken together.
  void sort_material(MaterialPoints<Dim>& points, int cells, int begin, int end) {
    next_.assign(static_cast<std::size_t>(cells) + 1, 0);
    for_runs(begin, end, [this](std::size_t c, int, int count) { next_[c + 1] += count; });
    int first = begin;
    for (int c = 0; c < cells; ++c) {
      const int count = std::exchange(next_[static_cast<std::size_t>(c) + 1], first);
      for (int part = 0; part < count; part += most_points) {
        points.cell.push_back(c);
        points.cell_begin.push_back(first + part);
      }
      first += count;
    }
    for_runs(begin, end, [this, from = order_.from().data()](std::size_t c, int run, int count) {
      int& next = next_[c + 1];
      std::iota(from + next, from + next + count, run);
      next += count;
    });
  }
  /// Calls visit(cell, first point, number of points) for each run of successive points in one cell.
  template <class Visit>
  void for_runs(int begin, int end, const Visit& visit) const {
    for (int p = begin; p < end;) {
      const int run = p, cell = cell_[static_cast<std::size_t>(p)];
      while (++p < end && cell_[static_cast<std::size_t>(p)] == cell) {
      }
      visit(static_cast<std::size_t>(cell), run, p - run);
    }
  }

  std::vector<double>& work_of(const std::vector<double>&) { return work_; }
  std::vector<int>& work_of(const std::vector<int>&) { return integer_work_; }

  Reordering order_;
  std::vector<int> cell_, next_, integer_work_;
  std::vector<double> work_;
};

}  // namespace stillpoint

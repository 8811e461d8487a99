// Keeps the material points sorted by material and cell as they move through the grid.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel_loop.hpp"
#include "space/points/material_points.hpp"
#include "space/points/point_domains.hpp"

namespace stillpoint {

template <class T>
void reorder(std::vector<T>& values, const std::vector<int>& order, std::vector<T>& work) {
  if (values.empty()) return;
  work.resize(order.size());
  for_each_index(order.size(), [&, from = values.data(), to = work.data(), at = order.data()](std::size_t k) {
    to[k] = from[at[k]];
  });
  values.swap(work);
}

/// Point k is from now on what point from[k] was: all that is kept of one goes with it.
template <int Dim>
void take_points(MaterialPoints<Dim>& points, const std::vector<int>& from, std::vector<double>& work,
                 std::vector<int>& integer_work) {
  for (auto& x : points.x) reorder(x, from, work);
  for (auto& v : points.v) reorder(v, from, work);
  for (auto& B : points.B_apic) reorder(B, from, work);
  for (auto& x : points.corner) reorder(x, from, work);
  for (auto& r : points.half) reorder(r, from, work);
  for (auto& X : points.rest) reorder(X, from, work);
  reorder(points.volume, from, work);
  reorder(points.mass, from, work);
  reorder(points.number, from, integer_work);
}

template <int Dim>
void take_points(MaterialPoints<Dim>& points, const std::vector<int>& from) {
  std::vector<double> work;
  std::vector<int> integer_work;
  take_points(points, from, work, integer_work);
}

template <int Dim>
class PointOrder {
 public:
  /// Longest list of points that counts as one cell; a fuller one is listed in parts.
  static constexpr int most_points = 128;

  /// Sorts the points and lists the cells that hold some, or whose functions hold at some. order(): which point each
  /// one was.
  void sort(MaterialPoints<Dim>& points, const Grid<Dim>& grid) {
    const std::size_t n = points.size();
    cell_.resize(n);
    std::array<double, Dim> cells_per_length;
    for (int d = 0; d < Dim; ++d) {
      // of the first cell: the last may be wider or narrower, next to a wall that the grid follows
      cells_per_length[d] = 1 / (grid.axes[d].nodes[1] - grid.axes[d].nodes[0]);
    }
    if (points.has_domains()) points.widest = widest_domain(grid);
    for_each_index(n, [&](std::size_t p) {
      std::array<int, Dim> cell;
      if (points.has_domains()) {
        cell = window_of(Domain<Dim>::in_grid(points, p, grid), grid);
      } else {
        for (int d = 0; d < Dim; ++d) cell[d] = grid.axes[d].cell_of(points.x[d][p], cells_per_length[d]);
      }
      cell_[p] = grid.cell_number(cell);
    });
    order_.resize(n);
    points.cell.clear();
    points.cell_begin.clear();
    for (std::size_t m = 0; m < points.materials(); ++m) {
      sort_material(points, grid.cells(), points.material_begin[m], points.material_begin[m + 1]);
    }
    points.cell_begin.push_back(static_cast<int>(n));
    take_points(points, order_, work_, integer_work_);
  }
  const std::vector<int>& order() const { return order_; }

 private:
  // Counting sort, stable, and the list of cells with their first points.
  void sort_material(MaterialPoints<Dim>& points, int cells, int begin, int end) {
    next_.assign(static_cast<std::size_t>(cells) + 1, 0);
    for (int p = begin; p < end; ++p) ++next_[static_cast<std::size_t>(cell_[static_cast<std::size_t>(p)]) + 1];
    int first = begin;
    for (int c = 0; c < cells; ++c) {
      int& count = next_[static_cast<std::size_t>(c) + 1];
      for (int part = 0; part < count; part += most_points) {
        points.cell.push_back(c);
        points.cell_begin.push_back(first + part);
      }
      next_[static_cast<std::size_t>(c)] = first;
      first += count;
    }
    for (int p = begin; p < end; ++p) {
      const auto c = static_cast<std::size_t>(cell_[static_cast<std::size_t>(p)]);
      order_[static_cast<std::size_t>(next_[c]++)] = p;
    }
  }

  std::vector<int> cell_, next_, order_, integer_work_;
  std::vector<double> work_;
};

}  // namespace stillpoint

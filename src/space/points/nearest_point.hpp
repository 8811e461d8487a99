// The material point nearest to a position, searched in the cells around it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <tuple>
#include <vector>

#include "space/points/material_points.hpp"

namespace stillpoint {

constexpr int any_field = -1;

/// A material point and the occupied cell that lists it.
struct PointInCell {
  std::size_t k = 0, p = 0;
};

/// How near a point is to a place; of points as near, that comes first whose cell is fewest cells from that of the
/// place, and then comes first in the grid. By default: there is no point.
struct Nearness {
  double square = std::numeric_limits<double>::infinity();  // of the distance [m²]
  int ring = 0, cell = 0;
  auto key() const { return std::tuple(square, ring, cell); }
};

template <int Dim>
class NearestPoint {
 public:
  /// Both arguments must outlive this object.
  NearestPoint(const MaterialPoints<Dim>& points, const Grid<Dim>& grid)
      : points_(points), grid_(grid), lists_(static_cast<std::size_t>(grid.cells()) + 1, 0), list_(points.cells()) {
    for (const int cell : points.cell) ++lists_[static_cast<std::size_t>(cell) + 1];
    for (std::size_t c = 1; c < lists_.size(); ++c) lists_[c] += lists_[c - 1];
    std::vector<int> next = lists_;
    for (std::size_t k = 0; k < points.cells(); ++k) {
      list_[static_cast<std::size_t>(next[static_cast<std::size_t>(points.cell[k])]++)] = k;
    }
    for (int d = 0; d < Dim; ++d) most_cells_ = std::max(most_cells_, grid.range(d).count());
  }

  /// The point nearest to x, of those in a field, of which there is at least one; of several equally near ones, one of
  /// those that the grid lists first.
  PointInCell to(const Point<Dim>& x, int field = any_field) const {
    const std::array<int, Dim> here = grid_.cell_of(x);
    PointInCell found;
    double least = std::numeric_limits<double>::infinity();
    for (int ring = 0; ring < most_cells_ && !(ring > 0 && least <= square(distance_to_ring(x, here, ring))); ++ring) {
      visit_ring(here, ring, [&](int cell) {
        for (int l = lists_[static_cast<std::size_t>(cell)]; l < lists_[static_cast<std::size_t>(cell) + 1]; ++l) {
          const std::size_t k = list_[static_cast<std::size_t>(l)];
          if (field != any_field && points_.field_of_cell(k) != field) continue;
          for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
            double distance = 0;
            for (int d = 0; d < Dim; ++d) distance += square(points_.x[d][p] - x[d]);
            if (distance >= least) continue;
            least = distance;
            found = {k, p};
          }
        }
      });
    }
    return found;
  }

  /// How near to() has come to x.
  Nearness nearness(const Point<Dim>& x, const PointInCell& found, int field = any_field) const {
    if (points_.size() == 0 || (field != any_field && points_.field_of_cell(found.k) != field)) return {};
    Nearness near{.square = 0, .cell = points_.cell[found.k]};
    const std::array<int, Dim> here = grid_.cell_of(x), there = grid_.cell_at(near.cell);
    for (int d = 0; d < Dim; ++d) {
      near.square += square(points_.x[d][found.p] - x[d]);
      near.ring = std::max(near.ring, std::abs(there[d] - here[d]));
    }
    return near;
  }

 private:
  static double square(double a) { return a * a; }

  /// The distance of x, in cell `here`, from the points of cells that are as many as `ring` cells away along some axis,
  /// or more; at least 0. A domain may begin a cell below its point, and is listed there.
  double distance_to_ring(const Point<Dim>& x, const std::array<int, Dim>& here, int ring) const {
    const int up_to = points_.has_domains() ? 2 : 1;
    double least = std::numeric_limits<double>::infinity();
    for (int d = 0; d < Dim; ++d) {
      const std::vector<double>& lines = grid_.axes[d].nodes;
      const int below = here[d] - ring, above = here[d] + ring;
      const auto [first, end] = grid_.range(d);
      if (below >= first) least = std::min(least, x[d] - lines[static_cast<std::size_t>(std::min(below + up_to, end))]);
      if (above < end) least = std::min(least, lines[static_cast<std::size_t>(above)] - x[d]);
    }
    return std::max(0.0, least);
  }

  /// Calls visit(cell) for the cells of the grid that are `ring` cells away along some axis, and no further along any.
  template <class Visit>
  void visit_ring(const std::array<int, Dim>& here, int ring, const Visit& visit) const {
    std::array<int, Dim> low, high;
    for (int d = 0; d < Dim; ++d) {
      low[d] = std::max(here[d] - ring, grid_.range(d).first);
      high[d] = std::min(here[d] + ring, grid_.range(d).end - 1);
    }
    std::array<int, Dim> cell = low;
    while (cell[Dim - 1] <= high[Dim - 1]) {
      int away = 0;
      for (int d = 0; d < Dim; ++d) away = std::max(away, std::abs(cell[d] - here[d]));
      if (away == ring) visit(grid_.cell_number(cell));
      int d = 0;
      while (++cell[d] > high[d] && d < Dim - 1) {
        cell[d] = low[d];
        ++d;
      }
    }
  }

  const MaterialPoints<Dim>& points_;
  const Grid<Dim>& grid_;
  std::vector<int> lists_;         // first entry of each cell in list_, (cells + 1)
  std::vector<std::size_t> list_;  // occupied cells by their grid number, (occupied cells)
  int most_cells_ = 0;             // largest number of cells along an axis
};

}  // namespace stillpoint

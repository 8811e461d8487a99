// The background grid: a rectilinear product of axes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace stillpoint {

/// Grid lines along one coordinate, strictly increasing [m]; cell c lies between nodes[c] and nodes[c + 1].
struct Axis {
  std::vector<double> nodes;
  bool is_even = true;  // whether the cells are equal, but for one next to a wall that the grid follows

  static Axis uniform(double min, double max, int cells) {
    Axis axis;
    for (int i = 0; i <= cells; ++i) axis.nodes.push_back(i == cells ? max : min + (max - min) * i / cells);
    return axis;
  }
  int cells() const { return static_cast<int>(nodes.size()) - 1; }
  double min() const { return nodes.front(); }
  double max() const { return nodes.back(); }
  /// The length to which lengths in a cell are related [m]: its own, or if the axis is even the mean.
  double scale_at(int cell) const {
    const auto c = static_cast<std::size_t>(cell);
    return is_even ? (max() - min()) / cells() : nodes[c + 1] - nodes[c];
  }
  /// The smallest of these [m].
  double smallest_scale() const {
    double smallest = scale_at(0);
    for (int c = 1; !is_even && c < cells(); ++c) smallest = std::min(smallest, scale_at(c));
    return smallest;
  }
  /// The cell that contains x: at a node the one above it, at the ends (and past them) the end cell.
  int cell_of(double x) const { return cell_of(x, cells() / (max() - min())); }
  /// As above, and faster if the lines are evenly spaced, or nearly so: cells_per_length is a mean [1/m].
  int cell_of(double x, double cells_per_length) const {
    const double guess = (x - nodes.front()) * cells_per_length;
    if (guess >= 0 && guess < static_cast<double>(nodes.size() - 1)) {
      const auto c = static_cast<std::size_t>(guess);
      if (nodes[c] <= x && x < nodes[c + 1]) return static_cast<int>(c);
    }
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
    return static_cast<int>(above - nodes.begin()) - 1;
  }
};

template <int Dim>
using Point = std::array<double, Dim>;

/// Cells of an axis.
struct CellRange {
  int first = 0, end = 0;

  int count() const { return end - first; }
  bool operator==(const CellRange&) const = default;
};

/// A grid whose cells are numbered with the first coordinate running fastest. Along an axis a cell has its place among
/// all cells there; a number have those of a box alone, in which the bodies lie, so that what is kept of each cell or
/// function takes no memory, and no time, for the empty rest of a large grid.
template <int Dim>
struct Grid {
  using Box = std::array<CellRange, Dim>;

  std::array<Axis, Dim> axes;
  Box box{};  // the cells that have numbers; of an axis with none: all

  /// The cells along an axis that have numbers.
  CellRange range(int d) const {
    const CellRange& of_box = box[static_cast<std::size_t>(d)];
    return of_box.end > 0 ? of_box : CellRange{0, axes[static_cast<std::size_t>(d)].cells()};
  }
  int cells() const {
    int count = 1;
    for (int d = 0; d < Dim; ++d) count *= range(d).count();
    return count;
  }
  bool holds(const std::array<int, Dim>& cell) const {
    for (int d = 0; d < Dim; ++d)
      if (cell[d] < range(d).first || cell[d] >= range(d).end) return false;
    return true;
  }
  /// The cell that contains x, of those that have numbers; of a place outside the nearest one.
  std::array<int, Dim> cell_of(const Point<Dim>& x) const {
    std::array<int, Dim> cell;
    for (int d = 0; d < Dim; ++d) cell[d] = std::clamp(axes[d].cell_of(x[d]), range(d).first, range(d).end - 1);
    return cell;
  }
  int cell_number(const std::array<int, Dim>& cell) const {
    int number = 0;
    for (int d = Dim - 1; d >= 0; --d) number = number * range(d).count() + cell[d] - range(d).first;
    return number;
  }
  std::array<int, Dim> cell_at(int number) const {
    std::array<int, Dim> cell;
    for (int d = 0; d < Dim; ++d) {
      const CellRange along = range(d);
      cell[d] = d + 1 < Dim ? along.first + number % along.count() : along.first + number;
      number /= along.count();
    }
    return cell;
  }
};

}  // namespace stillpoint

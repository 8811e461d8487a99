// The material points around a place, and polynomial fits to their values.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "space/points/local_fit.hpp"
#include "space/points/nearest_point.hpp"

namespace stillpoint {

template <int Dim>
class PointsAround {
  using Cell = std::array<int, Dim>;

 public:
  /// Point p in occupied cell k, and its weight in a fitted value.
  struct Share {
    std::size_t k, p;
    double weight;
  };

  /// Both arguments must outlive this object.
  PointsAround(const Grid<Dim>& grid, const MaterialPoints<Dim>& points) : grid_(grid), points_(points) {}

  PointInCell nearest(const Point<Dim>& x) const {
    if (!nearest_) nearest_.emplace(points_, grid_);
    return nearest_->to(x);
  }

  /// The least-squares fit at x, over the points of the cell of x and of all that touch it, of the material of the
  /// nearest one. The polynomial has this degree as far as the points determine it (local_fit.hpp), and the weights are
  ///
  ///   w_p = V_p Π_d (1 − (ξ_d/2)²)²,   ξ = (x_p − x)/h with the sides h of the widest cell around:
  ///
  /// so that nearer points count more.
  std::vector<Share> fit(const Point<Dim>& x, int degree) const {
    const Cell here = grid_.cell_of(x);
    Point<Dim> h{};
    for (int d = 0; d < Dim; ++d) {
      const Axis& axis = grid_.axes[d];
      for (const int beside : {here[d] - 1, here[d], here[d] + 1}) {
        const auto c = static_cast<std::size_t>(std::clamp(beside, 0, axis.cells() - 1));
        h[d] = std::max(h[d], axis.nodes[c + 1] - axis.nodes[c]);
      }
    }
    std::vector<PointInCell> around = points_around(here);
    if (around.empty()) around.push_back(nearest(x));
    const auto square_of_distance = [&](const PointInCell& point) {
      double sum = 0;
      for (int d = 0; d < Dim; ++d) {
        const double xi = (points_.x[d][point.p] - x[d]) / h[d];
        sum += xi * xi;
      }
      return sum;
    };
    const PointInCell first = *std::ranges::min_element(around, {}, square_of_distance);
    const int material = points_.material_of_cell(first.k);
    std::vector<Share> shares;
    std::vector<double> xi, weight;
    for (const auto& [k, p] : around) {
      if (points_.material_of_cell(k) != material) continue;
      double w = points_.volume[p];
      for (int d = 0; d < Dim; ++d) {
        constexpr double least = 1e-3;  // lower limit, for a point two cells away
        xi.push_back((points_.x[d][p] - x[d]) / h[d]);
        const double fall = std::max(1 - xi.back() * xi.back() / 4, least);
        w *= fall * fall;
      }
      weight.push_back(w);
      shares.push_back({k, p, 0});
    }
    const double largest = *std::ranges::max_element(weight);
    for (double& w : weight) w /= largest;
    const std::vector<double> c = local_fit(xi, weight, Dim, degree);
    for (std::size_t s = 0; s < shares.size(); ++s) shares[s].weight = c[s];
    return shares;
  }

 private:
  // Lists the points by their cells: those of cell c begin at list_begin_[c] in list_.
  void list_points() const {
    std::vector<std::size_t> cell_of(points_.size());
    list_begin_.assign(static_cast<std::size_t>(grid_.cells()) + 1, 0);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      cell_of[p] = static_cast<std::size_t>(grid_.cell_number(grid_.cell_of(points_.position(p))));
      ++list_begin_[cell_of[p] + 1];
    }
    for (std::size_t c = 1; c < list_begin_.size(); ++c) list_begin_[c] += list_begin_[c - 1];
    list_.resize(points_.size());
    std::vector<std::size_t> next = list_begin_;
    for (std::size_t k = 0; k < points_.cells(); ++k) {
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) list_[next[cell_of[p]]++] = {k, p};
    }
  }
  // The points of cell `here` and of all cells that touch it.
  std::vector<PointInCell> points_around(const Cell& here) const {
    return points_.has_domains() || Dim == 3 ? listed_around(here) : sorted_around(here);
  }
  // Finds the points on a line or in the plane, where they are sorted by their cells, which points with domains need
  // not be.
  std::vector<PointInCell> sorted_around(const Cell& here) const {
    Cell from, to;
    for (int d = 0; d < Dim; ++d) {
      from[d] = std::max(here[d] - 1, 0);
      to[d] = std::min(here[d] + 1, grid_.axes[d].cells() - 1);
    }
    const int rows = Dim == 1 ? 1 : to[Dim - 1] - from[Dim - 1] + 1, across = grid_.axes[0].cells();
    std::vector<PointInCell> found;
    for (std::size_t k = 0; k < points_.cells(); ++k) {
      const int beyond = points_.cell[k] - grid_.cell_number(from);
      if (beyond < 0 || beyond / across >= rows || beyond % across > to[0] - from[0]) continue;
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) found.push_back({k, p});
    }
    return found;
  }
  std::vector<PointInCell> listed_around(const Cell& here) const {
    if (list_begin_.empty()) list_points();
    std::vector<PointInCell> found;
    for (int k = 0; k < power(3, Dim); ++k) {
      Cell cell = here;
      bool is_cell = true;
      for (int d = 0; d < Dim; ++d) {
        cell[d] += k / power(3, d) % 3 - 1;
        is_cell = is_cell && cell[d] >= 0 && cell[d] < grid_.axes[d].cells();
      }
      if (!is_cell) continue;
      const auto number = static_cast<std::size_t>(grid_.cell_number(cell));
      for (std::size_t l = list_begin_[number]; l < list_begin_[number + 1]; ++l) found.push_back(list_[l]);
    }
    return found;
  }

  const Grid<Dim>& grid_;
  const MaterialPoints<Dim>& points_;
  // Made on demand:
  mutable std::optional<NearestPoint<Dim>> nearest_;
  mutable std::vector<std::size_t> list_begin_;
  mutable std::vector<PointInCell> list_;
};

}  // namespace stillpoint

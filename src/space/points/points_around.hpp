// The material points around a place, and polynomial fits to their values.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/points/local_fit.hpp"
#include "space/points/nearest_point.hpp"

namespace stillpoint {

template <int Dim>
class PointsAround {
  using Cell = std::array<int, Dim>;

 public:
  /// Point p in occupied cell k of a rank.
  struct Found {
    std::size_t k = 0, p = 0;
    int rank = 0, material = 0, field = 0, cell = 0;
    Point<Dim> x{};
    double volume = 0;
  };
  /// Its weight in a fitted value.
  struct Share {
    Found point;
    double weight;
  };

  /// The arguments must outlive this object. Where ranks share the points, all of them ask the same questions.
  PointsAround(const Grid<Dim>& grid, const MaterialPoints<Dim>& points, const Ranks* ranks)
      : grid_(grid), points_(points), ranks_(ranks) {}

  /// The nearest point, in the order of Nearness.
  Found nearest(const Point<Dim>& x) const {
    struct Candidate {
      Found point;
      Nearness near;
    };
    Candidate mine;
    if (points_.size() > 0) {
      if (!nearest_) nearest_.emplace(points_, grid_);
      const PointInCell at = nearest_->to(x);
      mine = {found(at), nearest_->nearness(x, at)};
    }
    return std::ranges::min(of_all(ranks_, mine), {}, [](const Candidate& one) { return one.near.key(); }).point;
  }

  /// The least-squares fit at x, over the points of the cells around, of the material of the nearest one. The
  /// polynomial has this degree as far as the points determine it (local_fit.hpp), and the weights are
  ///
  ///   w_p = V_p Π_d N(ξ_d),   ξ = (x_p − x)/h with the sides h of the widest cell around,
  ///
  /// with the quadratic B-spline N, which ends one and a half cells from x. Shifted by whole cells, N, ξ N and ξ² N
  /// each add up to a constant: amid points on all sides, what their values have wrong alike in each cell, and not on
  /// average, takes no part in a fit of degree 2.
  std::vector<Share> fit(const Point<Dim>& x, int degree) const {
    const Cell here = grid_.cell_of(x);
    Point<Dim> h{};
    Cell from, to;
    for (int d = 0; d < Dim; ++d) {
      const Axis& axis = grid_.axes[d];
      for (const int beside : {here[d] - 1, here[d], here[d] + 1}) {
        const auto c = static_cast<std::size_t>(std::clamp(beside, 0, axis.cells() - 1));
        h[d] = std::max(h[d], axis.nodes[c + 1] - axis.nodes[c]);
      }
      const auto line = [&](int i) { return axis.nodes[static_cast<std::size_t>(i)]; };
      const CellRange along = grid_.range(d);
      from[d] = here[d];
      while (from[d] > along.first && line(from[d]) > x[d] - reach * h[d]) --from[d];
      to[d] = here[d] + 1;
      while (to[d] < along.end && line(to[d]) < x[d] + reach * h[d]) ++to[d];
    }
    std::vector<Found> around = points_between(from, to);
    if (around.empty()) around.push_back(nearest(x));
    const auto square_of_distance = [&](const Found& point) {
      double sum = 0;
      for (int d = 0; d < Dim; ++d) {
        const double xi = (point.x[d] - x[d]) / h[d];
        sum += xi * xi;
      }
      return sum;
    };
    const int material = std::ranges::min_element(around, {}, square_of_distance)->material;
    std::vector<Share> shares;
    std::vector<double> xi, weight;
    for (const Found& point : around) {
      if (point.material != material) continue;
      double w = point.volume;
      for (int d = 0; d < Dim; ++d) {
        xi.push_back((point.x[d] - x[d]) / h[d]);
        w *= spline(std::abs(xi.back()));
      }
      weight.push_back(w);
      shares.push_back({point, 0});
    }
    const double largest = *std::ranges::max_element(weight);
    for (double& w : weight) w /= largest;
    const std::vector<double> c = local_fit(xi, weight, Dim, degree);
    for (std::size_t s = 0; s < shares.size(); ++s) shares[s].weight = c[s];
    return shares;
  }

  /// The values of the points of these shares, (shares × width): value_at(cell, point, out) writes those of a point
  /// that is here.
  template <class ValueAt>
  std::vector<double> values(const std::vector<Share>& shares, std::size_t width, const ValueAt& value_at) const {
    std::vector<double> values(shares.size() * width);
    for (std::size_t s = 0; s < shares.size(); ++s)
      if (shares[s].point.rank == own_rank())
        value_at(shares[s].point.k, shares[s].point.p, Vec(values).subspan(width * s, width));
    unite(ranks_, Vec(values));
    return values;
  }

 private:
  int own_rank() const { return ranks_ ? ranks_->rank() : 0; }
  Found found(const PointInCell& at) const {
    return {at.k,
            at.p,
            own_rank(),
            points_.material_of_cell(at.k),
            points_.field_of_cell(at.k),
            points_.cell[at.k],
            points_.position(at.p),
            points_.volume[at.p]};
  }

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
  static constexpr double reach = 1.5;  // [cells]

  // The quadratic B-spline times 4/3; a little beyond its end, for places where there are no other points.
  static double spline(double xi) {
    constexpr double least = 1e-6;
    const double value = xi < 0.5 ? 1 - 4 * xi * xi / 3 : xi < reach ? 2 * (reach - xi) * (reach - xi) / 3 : 0;
    return std::max(value, least);
  }

  // The points of the cells from `from` to the one before `to` along each axis.
  std::vector<Found> points_between(const Cell& from, const Cell& to) const {
    const bool by_lists = points_.has_domains() || Dim == 3;
    std::vector<Found> all;
    for (const PointInCell& at : by_lists ? listed_between(from, to) : sorted_between(from, to))
      all.push_back(found(at));
    if (!ranks_) return all;
    all = joined_lists(ranks_, std::move(all));
    std::ranges::stable_sort(all, {}, [by_lists](const Found& point) {
      return by_lists ? std::pair(point.cell, point.material) : std::pair(point.material, point.cell);
    });
    return all;
  }
  // Finds the points on a line or in the plane, where they are sorted by their cells, which points with domains need
  // not be.
  std::vector<PointInCell> sorted_between(const Cell& from, const Cell& to) const {
    const int rows = Dim == 1 ? 1 : to[Dim - 1] - from[Dim - 1], across = grid_.range(0).count();
    std::vector<PointInCell> found;
    for (std::size_t k = 0; k < points_.cells(); ++k) {
      const int beyond = points_.cell[k] - grid_.cell_number(from);
      if (beyond < 0 || beyond / across >= rows || beyond % across >= to[0] - from[0]) continue;
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) found.push_back({k, p});
    }
    return found;
  }
  std::vector<PointInCell> listed_between(const Cell& from, const Cell& to) const {
    if (list_begin_.empty()) list_points();
    std::vector<PointInCell> found;
    for (Cell cell = from; cell[Dim - 1] < to[Dim - 1];) {
      const auto number = static_cast<std::size_t>(grid_.cell_number(cell));
      for (std::size_t l = list_begin_[number]; l < list_begin_[number + 1]; ++l) found.push_back(list_[l]);
      int d = 0;
      while (++cell[d] == to[d] && d < Dim - 1) {
        cell[d] = from[d];
        ++d;
      }
    }
    return found;
  }

  const Grid<Dim>& grid_;
  const MaterialPoints<Dim>& points_;
  const Ranks* ranks_;
  // Made on demand:
  mutable std::optional<NearestPoint<Dim>> nearest_;
  mutable std::vector<std::size_t> list_begin_;
  mutable std::vector<PointInCell> list_;
};

}  // namespace stillpoint

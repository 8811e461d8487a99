// A function's coefficient from those of functions further inside the body, exact for linear fields.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "space/grid/basis.hpp"

namespace stillpoint {

/// u_i = Σ_k weight_k u_k with Σ weight_k = 1, so that a translation goes through unchanged, and if there are several
/// Σ weight_k x_k = x_i, x the centres of the functions: so does a rotation.
struct Extrapolation {
  int functions = 0;
  std::array<int, 8> function{};
  std::array<double, 8> weight{};
};

template <AxisBasis B, int Dim>
requires(B::partition_of_unity) class Extrapolator {
  using Basis = TensorBasis<B, Dim>;

 public:
  /// share: how much of what it should have a function has, (functions): those with 1 and more may be taken, with 0
  /// none. Both outlive this.
  Extrapolator(const Grid<Dim>& grid, const std::vector<double>& share) : grid_(grid), share_(share) {
    int stride = 1;
    for (int d = 0; d < Dim; ++d) {
      stride_[d] = stride;
      count_[d] = B::count(grid.axes[d]);
      stride *= count_[d];
    }
  }

  /// From the nearest pair along an axis; at a corner of the body, in space at an edge, from the nearest four that make
  /// a rectangle; at a corner in space from the nearest eight; where the body is too thin for these from the nearest
  /// one that shares a cell, or if none has its share from the one that has most of it. None if that is the function
  /// itself.
  std::optional<Extrapolation> operator()(int function) const {
    std::optional<Extrapolation> nearest;
    int distance = 2 * reach + 1;
    for (int d = 0; d < Dim; ++d) {
      for (const int sign : {-1, 1}) {
        for (int far = 2; far <= reach && far < distance; ++far) {
          Offset near{};
          near[static_cast<std::size_t>(d)] = sign * (far - 1);
          const auto found = from_box(function, near);
          if (!found) continue;
          nearest = found;
          distance = far;
        }
      }
    }
    if (nearest) return nearest;
    for (int axes = 2; axes <= Dim && !nearest; ++axes) nearest = from_nearest_box(function, axes);
    return nearest ? nearest : from_neighbour(function, share_[static_cast<std::size_t>(function)]);
  }

  /// Of a function that has more of its share than all that share a cell with it: the one next to it in that. None if
  /// it is alone.
  std::optional<Extrapolation> from_next_best(int function) const { return from_neighbour(function, 0); }

 private:
  static constexpr int reach = B::degree + 1;
  using Offset = std::array<int, Dim>;  // in functions along each axis

  // Along so many axes.
  std::optional<Extrapolation> from_nearest_box(int function, int axes) const {
    std::optional<Extrapolation> nearest;
    int distance = Dim * reach;
    for (int signs = 0; signs < 1 << Dim; ++signs) {
      for (int k = 0; k < power(reach, Dim); ++k) {
        Offset near{};
        int along = 0, away = 0;
        bool twice = false;  // of an offset of 0 either sign
        for (int d = 0; d < Dim; ++d) {
          const int steps = k / power(reach, Dim - 1 - d) % reach;
          const bool upwards = (signs >> (Dim - 1 - d) & 1) != 0;
          twice = twice || (steps == 0 && upwards);
          near[static_cast<std::size_t>(d)] = upwards ? steps : -steps;
          along += steps > 0 ? 1 : 0;
          away += steps;
        }
        if (along != axes || twice || away >= distance) continue;
        const auto found = from_box(function, near);
        if (!found) continue;
        nearest = found;
        distance = away;
      }
    }
    return nearest;
  }

  // With more than this share.
  std::optional<Extrapolation> from_neighbour(int function, double best) const {
    constexpr int span = 2 * B::degree + 1;
    std::optional<Extrapolation> nearest;
    int distance = 0;
    for (int k = 0; k < power(span, Dim); ++k) {
      int other = function, away = 0;
      bool exists = true;
      for (int d = 0; d < Dim; ++d) {
        const int by = k / power(span, d) % span - B::degree, at = Basis::index_along(grid_, function, d) + by;
        exists = exists && at >= 0 && at < count_[d];
        other += by * stride_[d];
        away += std::abs(by);
      }
      exists = exists && other != function;
      const double share = exists ? std::min(share_[static_cast<std::size_t>(other)], 1.0) : 0;
      if (!(share > best || (nearest && share == best && away < distance))) continue;
      nearest = Extrapolation{.functions = 1, .function = {other}, .weight = {1}};
      best = share;
      distance = away;
    }
    return nearest;
  }

  // Of the functions so far away and one more along each axis where that is not 0.
  std::optional<Extrapolation> from_box(int function, const Offset& near) const {
    Extrapolation box{.functions = 1, .function = {function}, .weight = {1}};
    for (int d = 0; d < Dim; ++d) {
      const int along = near[static_cast<std::size_t>(d)];
      if (along != 0 && !extend(box, function, d, along)) return std::nullopt;
    }
    for (int k = 0; k < box.functions; ++k) {
      if (!(share_[static_cast<std::size_t>(box.function[k])] >= 1)) return std::nullopt;
    }
    return box;
  }
  // w_1 = (x − x_2)/(x_1 − x_2), w_2 = 1 − w_1
  bool extend(Extrapolation& box, int function, int d, int near) const {
    const int here = Basis::index_along(grid_, function, d), first = here + near, second = first + (near > 0 ? 1 : -1);
    if (std::min(first, second) < 0 || std::max(first, second) >= count_[d]) return false;
    const Axis& axis = grid_.axes[d];
    const double x = B::centre(axis, here), x_1 = B::centre(axis, first), x_2 = B::centre(axis, second);
    const double w_1 = (x - x_2) / (x_1 - x_2);
    for (int k = 0; k < box.functions; ++k) {
      const int other = box.functions + k;
      box.function[other] = box.function[k] + (second - here) * stride_[d];
      box.weight[other] = box.weight[k] * (1 - w_1);
      box.function[k] += near * stride_[d];
      box.weight[k] *= w_1;
    }
    box.functions *= 2;
    return true;
  }

  const Grid<Dim>& grid_;
  const std::vector<double>& share_;
  std::array<int, Dim> stride_, count_;
};

}  // namespace stillpoint

// Extrapolation of a function's coefficient from those of functions further inside the body, exact for linear fields.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "space/grid/basis.hpp"

namespace stillpoint {

/// The extrapolation u_i = Σ_k weight_k u_k with Σ weight_k = 1, so that a translation is reproduced, and with several
/// sources Σ weight_k x_k = x_i, x the centres of the functions, so that a rotation is too.
struct Extrapolation {
  int functions = 0;
  std::array<int, 8> function{};
  std::array<double, 8> weight{};
};

template <AxisBasis B, int Dim>
requires(B::partition_of_unity) class Extrapolator {
  using Basis = TensorBasis<B, Dim>;

 public:
  /// share: how complete each function is, as a share of its full value, (functions): those with 1 and more may be
  /// sources, those with 0 may not. Both arguments must outlive this object.
  Extrapolator(const Grid<Dim>& grid, const std::vector<double>& share) : grid_(grid), share_(share) {
    int stride = 1;
    for (int d = 0; d < Dim; ++d) {
      stride_[d] = stride;
      count_[d] = B::count(grid.axes[d]);
      stride *= count_[d];
    }
  }

  /// Extrapolates from the nearest pair along an axis; at a corner of the body, in space at an edge, from the nearest
  /// four that form a rectangle; at a corner in space from the nearest eight; where the body is too thin for these from
  /// the nearest complete function that shares a cell, or if none is complete from the one with the largest share.
  /// Empty if that is the function itself.
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

  /// For a function with a larger share than all that share a cell with it: takes the one with the next largest share.
  /// Empty if there is no other function.
  std::optional<Extrapolation> from_next_best(int function) const { return from_neighbour(function, 0); }

 private:
  static constexpr int reach = B::degree + 1;
  using Offset = std::array<int, Dim>;  // in functions along each axis

  // Extrapolates from the nearest box that extends along this number of axes.
  std::optional<Extrapolation> from_nearest_box(int function, int axes) const {
    std::optional<Extrapolation> nearest;
    int distance = Dim * reach;
    for (int signs = 0; signs < 1 << Dim; ++signs) {
      for (int k = 0; k < power(reach, Dim); ++k) {
        Offset near{};
        int along = 0, away = 0;
        bool twice = false;  // an offset of 0 occurs with either sign
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

  // Extrapolates from the nearest function with a share above `best`.
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

  // Extrapolates from the box of the functions at this offset and the next ones along each axis whose offset is not 0.
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
  // Linear extrapolation along axis d: w_1 = (x − x_2)/(x_1 − x_2), w_2 = 1 − w_1
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

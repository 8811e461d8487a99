// Extrapolation of a function's coefficient from those of functions further inside the body, exact for linear fields.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "space/grid/grid_functions.hpp"

namespace stillpoint {

/// The extrapolation u_i = Σ_k weight_k u_k with Σ weight_k = 1, so that a translation is reproduced, and with several
/// sources Σ weight_k x_k = x_i, x the centres of the functions, so that a rotation is too.
struct Extrapolation {
  int functions = 0;
  std::array<int, 8> function{};
  std::array<double, 8> weight{};
};

template <int Dim>
class Extrapolator {
 public:
  /// functions: a partition of unity. share: how complete each function is, as a share of its full value, (functions):
  /// those with 1 and more may be sources, those with 0 may not. Both arguments must outlive this object.
  Extrapolator(const GridFunctions<Dim>& functions, const std::vector<double>& share);

  /// Extrapolates from the nearest pair along an axis; at a corner of the body, in space at an edge, from the nearest
  /// four that form a rectangle; at a corner in space from the nearest eight; where the body is too thin for these from
  /// the nearest complete function that shares a cell, or if none is complete from the one with the largest share.
  /// Empty if that is the function itself.
  std::optional<Extrapolation> operator()(int function) const;

  /// For a function with a larger share than all that share a cell with it: takes the one with the next largest share.
  /// Empty if there is no other function.
  std::optional<Extrapolation> from_next_best(int function) const { return from_neighbour(function, 0); }

 private:
  using Offset = std::array<int, Dim>;  // in functions along each axis

  std::optional<Extrapolation> from_nearest_box(int function, int axes) const;
  std::optional<Extrapolation> from_neighbour(int function, double best) const;
  std::optional<Extrapolation> from_box(int function, const Offset& near) const;
  bool extend(Extrapolation& box, int function, int d, int near) const;
  int index_along(int function, int d) const { return function / stride_[d] % count_[d]; }

  const GridFunctions<Dim>& functions_;
  const std::vector<double>& share_;
  int degree_, reach_;  // reach: as far as a source may lie, in functions along an axis
  std::array<int, Dim> stride_, count_;
};

}  // namespace stillpoint

// What loops over the points of trilinear cells share: eight points at a time, and the functions by their coefficients.
//
// With the position (x, y, z) of a point from the corner of its cell an interpolated quantity is
//
//   u = c + c_x x + c_y y + c_z z + c_xy xy + c_yz yz + c_zx zx + c_xyz xyz.
//
// A coefficient has a number m, whose bits are the axes that it has: c_xz has 0b101. A corner has the number whose bits
// are the axes along which it is at the upper end.
#pragma once

#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>

#include "base/lanes.hpp"
#include "space/kernels/point_weights.hpp"

namespace stillpoint {

struct Trilinear {
  using Weights = PointWeights<BSpline<1>, Kinematics::space>;
  static constexpr int dim = 3, corners = 8;
  static constexpr int lanes = 8;  // points at a time: the last of them may lie past the cell's end

  /// x, y and z of eight points from the corner of their cell, and for each axis the product of the two others.
  struct Positions {
    std::array<Lanes<8>, dim> along, product;

    [[gnu::always_inline]] Positions(const Weights& weights, std::size_t k, std::size_t p) {
      unroll<dim>([&](auto d) __attribute__((always_inline)) { along[d] = weights.eight_from_corner(d, k, p); });
      unroll<dim>([&](auto d) __attribute__((always_inline)) {
        product[d] = along[(d + 1) % dim].times(along[(d + 2) % dim]);
      });
    }
  };

  /// The components at corner a of cell k, and any number; u: over the grid's functions.
  template <class Corner>
  [[gnu::always_inline]] static Lanes<4> at_corner(const Weights& weights, std::size_t k, Corner a, const double* u) {
    return three_components<a == corners - 1>(u + dim * static_cast<std::ptrdiff_t>(weights.function(k, a)));
  }

  /// From the corners' values to the coefficients, in a cell of unit sides; and of the forces conjugate to the
  /// coefficients to those at the corners.
  template <class Value>
  [[gnu::always_inline]] static void to_coefficients(std::array<Value, corners>& c) {
    unroll<dim>([&](auto d) __attribute__((always_inline)) {
      unroll<corners>([&](auto m) __attribute__((always_inline)) {
        if constexpr ((m >> d & 1) != 0) c[m] = c[m].minus(c[m ^ (1 << d)]);
      });
    });
  }
  template <class Value>
  [[gnu::always_inline]] static void to_corners(std::array<Value, corners>& f) {
    unroll<dim>([&](auto d) __attribute__((always_inline)) {
      unroll<corners>([&](auto m) __attribute__((always_inline)) {
        if constexpr ((m >> d & 1) == 0) f[m] = f[m].minus(f[m | 1 << d]);
      });
    });
  }
  /// [m]: the product of 1/h_x, 1/h_y and 1/h_z to the powers of the bits of m, which a cell's sides make of c_m.
  [[gnu::always_inline]] static std::array<double, corners> inverse_products(const Weights& weights, std::size_t k) {
    const auto [x, y, z] = weights.cell(k).inverse_side;
    return {1, x, y, x * y, z, x * z, y * z, x * y * z};
  }

  /// [m]: the coefficients of up to eight quantities, in memory, from where an instruction takes one for all points:
  /// there are more of them than registers.
  template <int quantities>
  struct alignas(64) Coefficients : std::array<std::array<double, static_cast<std::size_t>(quantities)>, corners> {};
};

}  // namespace stillpoint

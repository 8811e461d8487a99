// Gather and scatter in trilinear cells, without weights. With the position (ξ, η, ζ) of a point in its cell a
// displacement is
//
//   u = c + c_x ξ + c_y η + c_z ζ + c_xy ξη + c_yz ηζ + c_zx ζξ + c_xyz ξηζ,
//   ∂u/∂x = (c_x + c_xy η + c_zx ζ + c_xyz ηζ)/h_x,   …
//
// so that the combinations of the corners are computed once a cell, and points are taken eight at a time. The scatter
// takes eight corners at a time: a point adds Σ_j V P_ij ∂N/∂x_j to all of them, from its factors ξ or 1 − ξ and so on.
#pragma once

#include "space/kernels/gather_scatter.hpp"

namespace stillpoint {

template <>
struct GatherScatter<BSpline<1>, Kinematics::space> {
  using Weights = PointWeights<BSpline<1>, Kinematics::space>;
  using Block = PointBlock<Kinematics::space>;
  using Rows = Block::Rows;
  static constexpr int dim = 3, corners = 8;
  static constexpr int lanes = 8;  // points at a time: the last of them may lie past the cell's end
  static_assert(Block::slack >= lanes - 1 && Weights::slack >= lanes - 1);
  using Eight = Lanes<8>;

  template <bool Increments>
  static void gather(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const double* u,
                     const double* u_before, std::size_t first, Rows& H, Rows& dH) {
    gather_one(
        weights, k, begin, end, first, H, [&](std::ptrdiff_t at) __attribute__((always_inline)) {
          return Lanes<4>{{u[at], u[at + 1], u[at + 2], 0}};
        });
    if constexpr (Increments) {
      gather_one(
          weights, k, begin, end, first, dH, [&](std::ptrdiff_t at) __attribute__((always_inline)) {
            return Lanes<4>{{u[at] - u_before[at], u[at + 1] - u_before[at + 1], u[at + 2] - u_before[at + 2], 0}};
          });
    }
  }

  static void scatter(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const Block& block,
                      double* corner) {
    // Corner a has along axis d the factor near + towards · position, with the slope towards/h.
    constexpr Eight::Register near_x{1, 0, 1, 0, 1, 0, 1, 0}, near_y{1, 1, 0, 0, 1, 1, 0, 0},
        near_z{1, 1, 1, 1, 0, 0, 0, 0};
    const Eight::Register to_x = 1 - 2 * near_x, to_y = 1 - 2 * near_y, to_z = 1 - 2 * near_z;
    const auto [per_x, per_y, per_z] = weights.cell(k).inverse_side;
    const Eight::Register slope_x = to_x * per_x, slope_y = to_y * per_y, slope_z = to_z * per_z;
    std::array<Eight::Register, dim> force{};
    for (std::size_t p = begin; p < end; ++p) {
      const std::size_t q = p - block.first;
      const Eight::Register X = near_x + to_x * weights.position_in_cell(0, k, p),
                            Y = near_y + to_y * weights.position_in_cell(1, k, p),
                            Z = near_z + to_z * weights.position_in_cell(2, k, p);
      const Eight::Register dN_x = slope_x * Y * Z, XZ = X * Z, dN_y = slope_y * XZ, dN_z = slope_z * X * Y;
      unroll<dim>([&](auto i) __attribute__((always_inline)) {
        force[i] += block.VP[dim * i][q] * dN_x + block.VP[dim * i + 1][q] * dN_y + block.VP[dim * i + 2][q] * dN_z;
      });
    }
    unroll<corners>([&](auto a) __attribute__((always_inline)) {
      unroll<dim>([&](auto i) __attribute__((always_inline)) { corner[dim * a + i] = Eight{force[i]}[a]; });
    });
  }

 private:
  // displacement(at): that of a corner whose first component is at `at` of the grid's displacements.
  template <class Displacement>
  [[gnu::always_inline]] static void gather_one(const Weights& weights, std::size_t k, std::size_t begin,
                                                std::size_t end, std::size_t first, Rows& H,
                                                const Displacement& displacement) {
    const auto corner = [&](int a) __attribute__((always_inline)) {
      return displacement(dim * static_cast<std::ptrdiff_t>(weights.function(k, a)));
    };
    const auto u_000 = corner(0), u_100 = corner(1), u_010 = corner(2), u_110 = corner(3);
    const auto u_001 = corner(4), u_101 = corner(5), u_011 = corner(6), u_111 = corner(7);
    const auto c_x = u_100.minus(u_000), c_y = u_010.minus(u_000), c_z = u_001.minus(u_000);
    const auto c_xy = u_110.minus(u_010).minus(c_x), c_yz = u_011.minus(u_001).minus(c_y);
    const auto c_zx = u_101.minus(u_001).minus(c_x);
    const auto c_xyz = u_111.minus(u_011).minus(u_101.minus(u_001)).minus(c_xy);
    const auto [per_x, per_y, per_z] = weights.cell(k).inverse_side;
    using Coefficients = std::array<Lanes<4>, 4>;  // of 1, of the positions along the other two axes, and of their
                                                   // product
    const Coefficients of_x{c_x.times(per_x), c_xy.times(per_x), c_zx.times(per_x), c_xyz.times(per_x)};
    const Coefficients of_y{c_y.times(per_y), c_xy.times(per_y), c_yz.times(per_y), c_xyz.times(per_y)};
    const Coefficients of_z{c_z.times(per_z), c_zx.times(per_z), c_yz.times(per_z), c_xyz.times(per_z)};
    // Entries past the end belong to the next cell, which overwrites them, or are unused.
    for (std::size_t p = begin; p < end; p += lanes) {
      const std::size_t q = p - first;
      const auto xi = weights.eight_in_cell(0, k, p), eta = weights.eight_in_cell(1, k, p),
                 zeta = weights.eight_in_cell(2, k, p);
      const auto along = [&](const Coefficients& of, int i, const Eight& s, const Eight& t, const Eight& st)
          __attribute__((always_inline)) {
        return Eight{of[0][i] + of[1][i] * s.lanes + of[2][i] * t.lanes + of[3][i] * st.lanes};
      };
      const Eight xi_eta = xi.times(eta), eta_zeta = eta.times(zeta), zeta_xi = zeta.times(xi);
      unroll<dim>([&](auto i) __attribute__((always_inline)) {
        along(of_x, i, eta, zeta, eta_zeta).store(&H[dim * i][q]);
        along(of_y, i, xi, zeta, zeta_xi).store(&H[dim * i + 1][q]);
        along(of_z, i, xi, eta, xi_eta).store(&H[dim * i + 2][q]);
      });
    }
  }
};

}  // namespace stillpoint

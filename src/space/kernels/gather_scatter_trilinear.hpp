// Gather and scatter in trilinear cells, without weights. With the coefficients of a displacement
//
//   ∂u/∂x = c_x + c_xy y + c_zx z + c_xyz yz,   …
//
// so that the combinations of the corners are computed once a cell, and points are taken eight at a time. The scatter
// is the transpose: the forces conjugate to these coefficients,
//
//   f_x = Σ_p V P_x,   f_xy = Σ_p (V P_x y + V P_y x),   f_xyz = Σ_p (V P_x yz + V P_y zx + V P_z xy),   …
//
// are summed over eight points at a time, and then go to the corners as the coefficients came from them.
#pragma once

#include <type_traits>

#include "space/kernels/gather_scatter.hpp"
#include "space/kernels/trilinear.hpp"

namespace stillpoint {

template <>
struct GatherScatter<BSpline<1>, Kinematics::space> : Trilinear {
  using Block = PointBlock<Kinematics::space>;
  using Rows = Block::Rows;
  static_assert(Block::slack >= lanes - 1 && Weights::slack >= lanes - 1);
  using Eight = Lanes<8>;
  using Four = Lanes<4>;

  template <bool Increments>
  static void gather(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const double* u,
                     const double* u_before, std::size_t first, Rows& H, Rows& dH) {
    // The displacement of a corner, followed by its increment.
    using Corner = std::conditional_t<Increments, Eight, Four>;
    std::array<Corner, corners> c;
    unroll<corners>([&](auto a) __attribute__((always_inline)) {
      const Four now = at_corner(weights, k, a, u);
      if constexpr (Increments) {
        c[a] = joined(now, now.minus(at_corner(weights, k, a, u_before)));
      } else {
        c[a] = now;
      }
    });
    to_coefficients(c);
    const auto per_sides = inverse_products(weights, k);
    Coefficients<Increments ? 8 : 4> in_memory;
    unroll<corners - 1>([&](auto m) __attribute__((always_inline)) {
      c[m + 1].times(per_sides[m + 1]).store(in_memory[m + 1].data());
    });
    for (std::size_t p = begin; p < end; p += lanes)
      gather_eight<Increments>(in_memory, Positions(weights, k, p), p - first, H, dH);
  }

  static void scatter(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const Block& block,
                      double* corner) {
    Conjugates f = conjugates(weights, k, begin, end, block);
    for (std::size_t p = begin + lanes; p < end; p += lanes) {
      const Conjugates more = conjugates(weights, k, p, end, block);
      unroll<corners - 1>([&](auto m) __attribute__((always_inline)) {
        unroll<dim>([&](auto i) __attribute__((always_inline)) { f[m + 1][i] = f[m + 1][i].plus(more[m + 1][i]); });
      });
    }
    const auto per_sides = inverse_products(weights, k);
    std::array<Four, corners> of_corner{};  // the three components, and any number
    unroll<corners - 1>([&](auto m) __attribute__((always_inline)) {
      of_corner[m + 1] = sums(f[m + 1][0], f[m + 1][1], f[m + 1][2]).times(per_sides[m + 1]);
    });
    to_corners(of_corner);
    // A store of four numbers is followed by one that begins with the fourth, but the last: what follows is not ours.
    unroll<corners - 1>([&](auto a) __attribute__((always_inline)) { of_corner[a].store(corner + dim * a); });
    unroll<dim>([&](auto i)
                    __attribute__((always_inline)) { corner[dim * (corners - 1) + i] = of_corner[corners - 1][i]; });
  }

 private:
  // [m][i]: the force conjugate to coefficient m of component i, of a point in each lane; none for m = 0.
  using Conjugates = std::array<std::array<Eight, dim>, corners>;

  // Of eight points from p on.
  [[gnu::always_inline]] static Conjugates conjugates(const Weights& weights, std::size_t k, std::size_t p,
                                                      std::size_t end, const Block& block) {
    const Positions at(weights, k, p);
    const Eight &X = at.along[0], &Y = at.along[1], &Z = at.along[2];
    const Eight &YZ = at.product[0], &ZX = at.product[1], &XY = at.product[2];
    Conjugates f;
    unroll<dim>([&](auto i) __attribute__((always_inline)) {
      const auto force = [&](int j) __attribute__((always_inline)) {
        return Eight::load(&block.VP[static_cast<std::size_t>(dim * i + j)][p - block.first]).first(end - p);
      };
      const Eight x = force(0), y = force(1), z = force(2);
      f[1][i] = x;
      f[2][i] = y;
      f[3][i] = x.times(Y).plus_product(y, X);
      f[4][i] = z;
      f[5][i] = z.times(X).plus_product(x, Z);
      f[6][i] = y.times(Z).plus_product(z, Y);
      f[7][i] = x.times(YZ).plus_product(y, ZX).plus_product(z, XY);
    });
    return f;
  }

  // Entries past the end of the cell belong to the next one, which overwrites them, or are unused. Inlined, it would
  // have all coefficients in registers.
  template <bool Increments>
  [[gnu::noinline]] static void gather_eight(const Coefficients<Increments ? 8 : 4>& c, const Positions& at,
                                             std::size_t q, Rows& H, Rows& dH) {
    const auto derivatives = [&](int component, Rows& rows, int i) __attribute__((always_inline)) {
      std::array<double, corners> of;  // copied first: as far as the compiler knows, rows and coefficients may overlap
      unroll<corners - 1>([&](auto m) __attribute__((always_inline)) { of[m + 1] = c[m + 1][component]; });
      unroll<dim>([&](auto d) __attribute__((always_inline)) {
        constexpr int e = (d + 1) % dim, f = (d + 2) % dim;
        Eight{of[1 << d] + of[1 << d | 1 << e] * at.along[e].lanes + of[1 << d | 1 << f] * at.along[f].lanes +
              of[corners - 1] * at.product[d].lanes}
            .store(&rows[dim * i + d][q]);
      });
    };
    unroll<dim>([&](auto i) __attribute__((always_inline)) {
      derivatives(i, H, i);
      if constexpr (Increments) derivatives(4 + i, dH, i);
    });
  }
};

}  // namespace stillpoint

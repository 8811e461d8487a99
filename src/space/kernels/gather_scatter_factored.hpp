// Gather and scatter in space, for functions that are products of one function along each axis, from the factors of a
// point:
//
//   H_ij = Σ_c Σ_b Σ_a u_abc,i X_a Y_b Z_c   with the slope in place of the factor along j,
//
// one axis after the other, so that common parts of sums are computed once: 270 products a point for 27 functions, and
// 18 numbers to read instead of 81. Eight points are taken at a time; in the scatter each corner's force is summed over
// the eight lanes at the end of the cell.
#pragma once

#include "space/kernels/gather_scatter.hpp"

namespace stillpoint {

template <AxisBasis B>
struct GatherScatter<B, Kinematics::space> {
  using Weights = PointWeights<B, Kinematics::space>;
  using Block = PointBlock<Kinematics::space>;
  using Rows = Block::Rows;
  static constexpr int dim = 3, along_axis = B::per_cell, per_cell = Weights::per_cell;
  static constexpr int lanes = 8;  // points at a time: the last of them may lie past the cell's end
  static_assert(Block::slack >= lanes - 1 && Weights::slack >= lanes - 1);
  using Eight = Lanes<8>;

  template <bool Increments>
  static void gather(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const double* u,
                     const double* u_before, std::size_t first, Rows& H, Rows& dH) {
    Corners now, change;
    unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
      constexpr bool is_last = a == per_cell - 1;
      const auto at = dim * static_cast<std::ptrdiff_t>(weights.function(k, a));
      const auto of_function = three_components<is_last>(u + at);
      of_function.store(now[a].data());
      if constexpr (Increments) of_function.minus(three_components<is_last>(u_before + at)).store(change[a].data());
    });
    gather_one(weights, begin, end, first, now, H);
    if constexpr (Increments) gather_one(weights, begin, end, first, change, dH);
  }

  static void scatter(const Weights& weights, std::size_t, std::size_t begin, std::size_t end, const Block& block,
                      double* corner) {
    std::array<std::array<Lanes<4>, per_cell>, dim> force{};  // each the sum of its lanes
    for (std::size_t p = begin; p < end; p += lanes) {
      const Factors at(weights, p);
      const auto stress = [&](int ij) __attribute__((always_inline)) {
        return Eight::load_first(&block.VP[static_cast<std::size_t>(ij)][p - block.first], end - p);
      };
      unroll<dim>([&](auto i) __attribute__((always_inline)) {
        const Eight P_x = stress(dim * i), P_y = stress(dim * i + 1), P_z = stress(dim * i + 2);
        unroll<along_axis>([&](auto c) __attribute__((always_inline)) {
          const Eight x_z = P_x.times(at.N[2][c]), y_z = P_y.times(at.N[2][c]), z_z = P_z.times(at.slope[2][c]);
          unroll<along_axis>([&](auto b) __attribute__((always_inline)) {
            const Eight with_slope = x_z.times(at.N[1][b]);
            const Eight with_value = y_z.times(at.slope[1][b]).plus_product(z_z, at.N[1][b]);
            unroll<along_axis>([&](auto a) __attribute__((always_inline)) {
              Lanes<4>& sum = force[i][a + along_axis * (b + along_axis * c)];
              const Eight of_points = with_slope.times(at.slope[0][a]).plus_product(with_value, at.N[0][a]);
              sum = sum.plus(halves_added(of_points));
            });
          });
        });
      });
    }
    for (int i = 0; i < dim; ++i) {
      for (int a = 0; a < per_cell; a += 4) {
        const auto lanes_of = [&](int of) { return force[i][std::min(of, per_cell - 1)]; };
        const auto four = sums(lanes_of(a), lanes_of(a + 1), lanes_of(a + 2), lanes_of(a + 3));
        for (int s = 0; s < std::min(4, per_cell - a); ++s) corner[dim * (a + s) + i] = four[s];
      }
    }
  }

 private:
  // The components of a displacement at each function, and any number.
  struct alignas(32) Corners : std::array<std::array<double, 4>, per_cell> {};

  // The factors of eight points from p on.
  struct Factors {
    std::array<std::array<Eight, along_axis>, dim> N, slope;

    [[gnu::always_inline]] Factors(const Weights& weights, std::size_t p) {
      unroll<dim>([&](auto d) __attribute__((always_inline)) {
        unroll<along_axis>([&](auto a) __attribute__((always_inline)) {
          N[d][a] = Eight::load(weights.factor(d, a) + p);
          slope[d][a] = Eight::load(weights.slope(d, a) + p);
        });
      });
    }
  };

  // Entries past the end belong to the next cell, which overwrites them, or are unused.
  static void gather_one(const Weights& weights, std::size_t begin, std::size_t end, std::size_t first,
                         const Corners& corners, Rows& H) {
    for (std::size_t p = begin; p < end; p += lanes) {
      const std::size_t q = p - first;
      const Factors at(weights, p);
      unroll<dim>([&](auto i) __attribute__((always_inline)) {
        Eight H_x{}, H_y{}, H_z{};
        unroll<along_axis>([&](auto c) __attribute__((always_inline)) {
          Eight of_x{}, of_y{}, of_z{};
          unroll<along_axis>([&](auto b) __attribute__((always_inline)) {
            Eight value{}, slope{};
            unroll<along_axis>([&](auto a) __attribute__((always_inline)) {
              const double u = corners[a + along_axis * (b + along_axis * c)][i];
              value.add(u, at.N[0][a]);
              slope.add(u, at.slope[0][a]);
            });
            of_x = of_x.plus_product(slope, at.N[1][b]);
            of_y = of_y.plus_product(value, at.slope[1][b]);
            of_z = of_z.plus_product(value, at.N[1][b]);
          });
          H_x = H_x.plus_product(of_x, at.N[2][c]);
          H_y = H_y.plus_product(of_y, at.N[2][c]);
          H_z = H_z.plus_product(of_z, at.slope[2][c]);
        });
        H_x.store(&H[dim * i][q]);
        H_y.store(&H[dim * i + 1][q]);
        H_z.store(&H[dim * i + 2][q]);
      });
    }
  }
};

}  // namespace stillpoint

// The new positions and velocities of the material points when a phase ends, in one pass over the cells:
//
//   x_p⁺ = x_p + Σ_i N_ip u_i,   v_p⁺ = s v_p + Σ_i N_ip w_i
//
// They are kept apart from the points, which stay unchanged if one of them would leave the grid.
#pragma once

#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>
#include <vector>

#include "base/lanes.hpp"
#include "base/parallel_loop.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/kernels/trilinear.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PointMotion {
  using Weights = PointWeights<B, K>;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  static constexpr int lanes = dim == 3 ? 4 : dim, width = 2 * lanes;  // width: u, followed by w
  static constexpr bool is_trilinear = Weights::from_positions && dim == 3;
  using Points = MaterialPoints<dim>;
  using Corners = std::array<Lanes<width>, per_cell>;

 public:
  /// u, w: over the grid's functions, component i at [dim function + i]. after(k) is called after occupied cell k, in
  /// parallel.
  template <class After>
  void find(const Points& points, const Weights& weights, const double* u, const double* w, double s,
            const After& after) {
    for (int d = 0; d < dim; ++d) {
      x[d].resize(points.size());
      v[d].resize(points.size());
    }
    for_each_block(points.cells(), [&](std::size_t k) {
      if constexpr (is_trilinear) {
        find_in_trilinear_cell(points, weights, k, u, w, s);
        after(k);
        return;
      }
      Corners corners;
      unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
        const auto at = dim * static_cast<std::ptrdiff_t>(weights.function(k, a));
        corners[a] = joined(Lanes<lanes>::load_first(u + at, dim), Lanes<lanes>::load_first(w + at, dim));
      });
      find_in_cell(points, points.begin(k), points.end(k), field(weights, k, corners), s);
      after(k);
    });
  }

  std::array<std::vector<double>, dim> x, v;  // x⁺ [m] and v⁺ [m/s], each (points)

 private:
  // The function that gives (Σ N u_i, Σ N w_i) of a point by its number, in occupied cell k.
  [[gnu::always_inline]] static auto field(const Weights& weights, std::size_t k, const Corners& corners) {
    if constexpr (Weights::from_positions && dim == 2) {
      // Σ_a N_a c_a = c_00 + (c_10 − c_00) ξ + [c_01 − c_00 + (c_11 − c_01 − c_10 + c_00) ξ] η
      const Lanes<width> lower = corners[1].minus(corners[0]), left = corners[2].minus(corners[0]);
      const Lanes<width> twist = corners[3].minus(corners[2]).minus(lower);
      return [
        c_00 = corners[0], lower, left, twist, xi = weights.position_in_cell(0), eta = weights.position_in_cell(1)
      ](std::size_t p) __attribute__((always_inline)) {
        Lanes<width> along = c_00, rise = left;
        along.add(xi[p], lower);
        rise.add(xi[p], twist);
        along.add(eta[p], rise);
        return along;
      };
    } else {
      return [&weights, &corners, k ](std::size_t p) __attribute__((always_inline)) {
        const auto N = weights.N(k, p);
        Lanes<width> sum{};
        unroll<per_cell>([&](auto a) __attribute__((always_inline)) { sum.add(N[a], corners[a]); });
        return sum;
      };
    }
  }
  // Eight points at a time; what lies past the cell's end belongs to others.
  void find_in_trilinear_cell(const Points& points, const Weights& weights, std::size_t k, const double* u,
                              const double* w, double s) requires(is_trilinear) {
    Corners c;
    unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
      c[a] = joined(Trilinear::at_corner(weights, k, a, u), Trilinear::at_corner(weights, k, a, w));
    });
    Trilinear::to_coefficients(c);
    const auto per_sides = Trilinear::inverse_products(weights, k);
    Trilinear::Coefficients<width> in_memory;
    unroll<per_cell>([&](auto m)
                         __attribute__((always_inline)) { c[m].times(per_sides[m]).store(in_memory[m].data()); });
    const std::size_t end = points.end(k);
    for (std::size_t p = points.begin(k); p < end; p += Trilinear::lanes)
      find_eight(points, in_memory, Trilinear::Positions(weights, k, p), p, end - p, s);
  }
  [[gnu::noinline]] void find_eight(const Points& points, const Trilinear::Coefficients<width>& c,
                                    const Trilinear::Positions& at, std::size_t p, std::size_t count, double s) {
    using Eight = Lanes<8>;
    const Eight &X = at.along[0], &Y = at.along[1], &Z = at.along[2];
    const Eight &YZ = at.product[0], &ZX = at.product[1], &XY = at.product[2];
    const Eight XYZ = X.times(YZ);
    const auto interpolated = [&](int of) __attribute__((always_inline)) {
      return Eight{c[0][of] + c[1][of] * X.lanes + c[2][of] * Y.lanes + c[3][of] * XY.lanes + c[4][of] * Z.lanes +
                   c[5][of] * ZX.lanes + c[6][of] * YZ.lanes + c[7][of] * XYZ.lanes};
    };
    unroll<dim>([&](auto d) __attribute__((always_inline)) {
      const Eight before = Eight::load_first(points.x[d].data() + p, count),
                  v_before = Eight::load_first(points.v[d].data() + p, count);
      const Eight way = interpolated(d), change = interpolated(lanes + d);
      before.plus(way).store_first(x[d].data() + p, count);
      change.plus(v_before.times(s)).store_first(v[d].data() + p, count);
    });
  }

  template <class Field>
  [[gnu::always_inline]] void find_in_cell(const Points& points, std::size_t begin, std::size_t end, const Field& field,
                                           double s) {
    std::size_t p = begin;
    if constexpr (width == 4) {
      for (; p + 4 <= end; p += 4) {
        const auto rows = transposed({field(p), field(p + 1), field(p + 2), field(p + 3)});
        unroll<dim>([&](auto d) __attribute__((always_inline)) {
          Lanes<4>::load(points.x[d].data() + p).plus(rows[d]).store(x[d].data() + p);
          rows[lanes + d]
              .plus_product(Lanes<4>{{s, s, s, s}}, Lanes<4>::load(points.v[d].data() + p))
              .store(v[d].data() + p);
        });
      }
    }
    for (; p < end; ++p) {
      const Lanes<width> sum = field(p);
      unroll<dim>([&](auto d) __attribute__((always_inline)) {
        x[d][p] = points.x[d][p] + sum[d];
        v[d][p] = s * points.v[d][p] + sum[lanes + d];
      });
    }
  }
};

}  // namespace stillpoint

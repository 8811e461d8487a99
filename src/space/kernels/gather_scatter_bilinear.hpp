// Gather and scatter in bilinear cells, without weights. With the position (ξ, η) of a point in its cell and the
// corners' displacements u_00, u_10, u_01, u_11,
//
//   ∂u/∂x = [(u_10 − u_00) + η (u_11 − u_01 − u_10 + u_00)]/h_x = a + b η,    ∂u/∂y = c + d ξ   likewise,
//
// so that the combinations of the corners are computed once a cell, and points are taken a few at a time. The scatter
// needs only the sums S = Σ V P and T = Σ V P η (or ξ) over the points:
//
//   Σ_p V_p P_ix ∂N_00/∂x = −(S_ix − T_ix)/h_x,   ∂N_10: (S_ix − T_ix)/h_x,   ∂N_01: −T_ix/h_x,   ∂N_11: T_ix/h_x.
//
// Axisymmetric cells also have u_r/r = (e + f ξ + g η + m ξη)/r and the sums of V P_θθ/r with 1, ξ, η, ξη.
#pragma once

#include "space/kernels/gather_scatter.hpp"

namespace stillpoint {

template <Kinematics K>
requires(dimensions(K) == 2) struct GatherScatter<BSpline<1>, K> {
  using Weights = PointWeights<BSpline<1>, K>;
  using Block = PointBlock<K>;
  using Rows = typename Block::Rows;
  static constexpr int dim = 2;
  static constexpr bool hoop = K == Kinematics::axisymmetric;
  static constexpr int lanes = 4;  // points at a time: the last of them may lie past the cell's end
  static_assert(Block::slack >= lanes - 1 && Weights::slack >= lanes - 1);
  using Points = Lanes<lanes>;

  template <bool Increments>
  static void gather(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const double* u,
                     const double* u_before, std::size_t first, Rows& H, Rows& dH) {
    constexpr int width = Increments ? 2 * dim : dim;  // number of lanes: u, followed by u − u_before
    const auto corner = [&](int a) __attribute__((always_inline)) {
      const auto at = dim * static_cast<std::ptrdiff_t>(weights.function(k, a));
      const auto now = Lanes<dim>::load(u + at);
      if constexpr (Increments) {
        return joined(now, now.minus(Lanes<dim>::load(u_before + at)));
      } else {
        return now;
      }
    };
    const Lanes<width> u_00 = corner(0), u_10 = corner(1), u_01 = corner(2), u_11 = corner(3);
    const auto& cell = weights.cell(k);
    const Lanes<width> lower = u_10.minus(u_00), left = u_01.minus(u_00), twist = u_11.minus(u_01).minus(lower);
    const auto a = lower.times(cell.inverse_side[0]), b = twist.times(cell.inverse_side[0]);
    const auto c = left.times(cell.inverse_side[1]), d = twist.times(cell.inverse_side[1]);

    // Entries past the end belong to the next cell, which overwrites them, or are unused.
    for (std::size_t p = begin; p < end; p += lanes) {
      const std::size_t q = p - first;
      const auto xi = Points::load(weights.position_in_cell(0) + p),
                 eta = Points::load(weights.position_in_cell(1) + p);
      unroll<dim>([&](auto i) __attribute__((always_inline)) {
        line(a[i], b[i], eta).store(&H[dim * i][q]);
        line(c[i], d[i], xi).store(&H[dim * i + 1][q]);
        if constexpr (Increments) {
          line(a[dim + i], b[dim + i], eta).store(&dH[dim * i][q]);
          line(c[dim + i], d[dim + i], xi).store(&dH[dim * i + 1][q]);
        }
      });
      if constexpr (hoop) {
        const auto radius = line(cell.left[0], cell.side[0], xi);
        const auto of = [&](int i) __attribute__((always_inline)) {
          const auto along_lower = line(u_00[i], lower[i], xi), rise = line(left[i], twist[i], xi);
          return along_lower.plus_product(rise, eta).over(radius);
        };
        of(0).store(&H[dim * dim][q]);
        if constexpr (Increments) of(dim).store(&dH[dim * dim][q]);
      }
    }
  }

  static void scatter(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const Block& block,
                      double* corner) {
    std::array<Points, dim * dim> S{}, T{};  // sums of V P_ij
    std::array<Points, 4> of_hoop{};         // sums of V P_θθ/r with 1, ξ, η, ξη
    const auto& cell = weights.cell(k);
    for (std::size_t p = begin; p < end; p += lanes) {
      const std::size_t q = p - block.first;
      const std::size_t inside = end - p;
      const auto xi = Points::load(weights.position_in_cell(0) + p),
                 eta = Points::load(weights.position_in_cell(1) + p);
      unroll<dim * dim>([&](auto ij) __attribute__((always_inline)) {
        const auto VP = Points::load(&block.VP[ij][q]).first(inside);
        S[ij] = S[ij].plus(VP);
        T[ij] = T[ij].plus_product(VP, ij % dim == 0 ? eta : xi);
      });
      if constexpr (hoop) {
        const auto radius = line(cell.left[0], cell.side[0], xi);
        const auto VP = Points::load(&block.VP[dim * dim][q]).over(radius).first(inside);
        const auto VP_eta = VP.times(eta);
        of_hoop[0] = of_hoop[0].plus(VP);
        of_hoop[1] = of_hoop[1].plus_product(VP, xi);
        of_hoop[2] = of_hoop[2].plus(VP_eta);
        of_hoop[3] = of_hoop[3].plus_product(VP_eta, xi);
      }
    }
    // Lanes: (xx, yx), (xy, yy), a pair for either derivative; the far side takes T, the near side the rest of S.
    const auto [per_x, per_y] = cell.inverse_side;
    const Lanes<4> scale{{per_x, per_x, per_y, per_y}};
    const Lanes<4> far = sums(T[0], T[2], T[1], T[3]).times(scale);
    const Lanes<4> near = sums(S[0], S[2], S[1], S[3]).times(scale).minus(far);
    lower_half(near).plus(upper_half(near)).times(-1).store(corner);
    near.minus(halves_swapped(far)).store(corner + dim);
    lower_half(far).plus(upper_half(far)).store(corner + 3 * dim);
    if constexpr (hoop) {
      const auto m = sums(of_hoop[0], of_hoop[1], of_hoop[2], of_hoop[3]);  // Σ V P/r (1, ξ, η, ξη)
      corner[0] += m[0] - m[1] - m[2] + m[3];
      corner[dim] += m[1] - m[3];
      corner[2 * dim] += m[2] - m[3];
      corner[3 * dim] += m[3];
    }
  }

 private:
  /// The linear function start + slope · x.
  [[gnu::always_inline]] static Points line(double start, double slope, const Points& x) {
    return {start + slope * x.lanes};
  }
};

}  // namespace stillpoint

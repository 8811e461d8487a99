// The transfer between a cell's corners and its points: ∂u/∂x at the points from the displacements of the corners, and
// forces at the corners from the stresses of the points. The general version uses the stored weights; bilinear cells
// and all functions in space have specialisations.
#pragma once

#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>

#include "base/lanes.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/materials/point_material.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
struct GatherScatter {
  using Weights = PointWeights<B, K>;
  using Block = PointBlock<K>;
  using Rows = typename Block::Rows;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  static constexpr int rows = Weights::rows;

  /// H_p = Σ_a u_a ⊗ ∇N_ap, and if Increments dH for u − u_before, for the points begin … end − 1 of occupied cell k;
  /// rows begin with point number `first`. u, u_before: over the grid's functions, component i at [dim function + i].
  template <bool Increments>
  static void gather(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const double* u,
                     const double* u_before, std::size_t first, Rows& H, Rows& dH) {
    constexpr int width = Increments ? 2 * dim : dim;  // number of lanes: u, followed by u − u_before
    std::array<Lanes<width>, per_cell> of_corner;
    unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
      const auto at = dim * static_cast<std::ptrdiff_t>(weights.function(k, a));
      const auto now = Lanes<dim>::load(u + at);
      if constexpr (Increments) {
        of_corner[a] = joined(now, now.minus(Lanes<dim>::load(u_before + at)));
      } else {
        of_corner[a] = now;
      }
    });
    for (std::size_t p = begin; p < end; ++p) {
      const double* dN = weights.dN(k, p);
      std::array<Lanes<width>, rows> h{};
      unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
        unroll<rows>([&](auto j) __attribute__((always_inline)) { h[j].add(dN[per_cell * j + a], of_corner[a]); });
      });
      const std::size_t q = p - first;
      unroll<dim * dim>([&](auto ij) __attribute__((always_inline)) {
        constexpr int i = ij / dim, j = ij % dim;
        H[ij][q] = h[j][i];
        if constexpr (Increments) dH[ij][q] = h[j][dim + i];
      });
      if constexpr (rows > dim) {
        H[dim * dim][q] = h[dim][0];
        if constexpr (Increments) dH[dim * dim][q] = h[dim][dim];
      }
    }
  }

  /// Sets corner[dim a + i] = Σ_p V_p P_ij ∂N_ap/∂x_j over those points, (dim × per_cell) [N]. Local functions are
  /// taken a few at a time; lanes past the last of them read on into the following memory, and are dropped.
  static void scatter(const Weights& weights, std::size_t k, std::size_t begin, std::size_t end, const Block& block,
                      double* corner) {
    constexpr int lanes = per_cell < 4 ? 2 : 4, chunks = (per_cell + lanes - 1) / lanes;
    std::array<std::array<Lanes<lanes>, chunks>, dim> force{};
    for (std::size_t p = begin; p < end; ++p) {
      const std::size_t q = p - block.first;
      const double* dN = weights.dN(k, p);
      unroll<dim * chunks>([&](auto ic) __attribute__((always_inline)) {
        constexpr int i = ic / chunks, c = ic % chunks;
        unroll<dim>([&](auto j) __attribute__((always_inline)) {
          force[i][c].add(block.VP[dim * i + j][q], Lanes<lanes>::load(dN + per_cell * j + lanes * c));
        });
        if constexpr (rows > dim && i == 0) {
          force[0][c].add(block.VP[dim * dim][q], Lanes<lanes>::load(dN + per_cell * dim + lanes * c));
        }
      });
    }
    unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
      unroll<dim>([&](auto i) __attribute__((always_inline)) { corner[dim * a + i] = force[i][a / lanes][a % lanes]; });
    });
  }
};

}  // namespace stillpoint

// The change of volume of a block's points: j = J − 1, J = det(I + H), and ∂j/∂H = cof(I + H), or to first order tr H
// and I. j is summed from H itself, so that a small one keeps the digits that J loses beside 1.
#pragma once

#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>

#include "space/materials/point_material.hpp"

namespace stillpoint {

/// The change of volume in plane strain, axisymmetric with components rr, rz, zr, zz, θθ, or in space.
template <Kinematics K>
requires(dimensions(K) > 1) struct ChangeOfVolume {
  static constexpr int components = gradient_components(K);
  static constexpr bool has_hoop = K == Kinematics::axisymmetric, in_space = K == Kinematics::space;
  static constexpr int second = in_space ? 4 : 3;  // index of the second component on the diagonal
  static constexpr std::array<bool, components> on_diagonal = [] {
    std::array<bool, components> diagonal{};
    diagonal[0] = diagonal[second] = diagonal[components - 1] = true;
    return diagonal;
  }();
  using Block = PointBlock<K>;
  using Row = typename Block::Row;
  using Tensor = TensorOf<K>;

  /// Sets j to J − 1, or at small strain to tr H, for the block's points.
  static void of_block(const Block& block, bool finite_strain, Row& j) {
    finite_strain ? of_block_as<true>(block, j) : of_block_as<false>(block, j);
  }
  template <bool Finite>
  [[gnu::always_inline]] static void of_block_as(const Block& block, Row& j) {
#pragma omp simd
    for (std::size_t q = 0; q < block.count; ++q) {
      if constexpr (Finite && in_space) {
        const SpaceTensor H = stillpoint::in_space(block.H_at(q));
        j[q] = change_of_volume(H, stillpoint::cofactor(H));
      } else if constexpr (Finite) {
        const double in_plane =
            block.H[0][q] + block.H[3][q] + (block.H[0][q] * block.H[3][q] - block.H[1][q] * block.H[2][q]);
        j[q] = has_hoop ? in_plane + (1 + in_plane) * block.H[components - 1][q] : in_plane;
      } else {
        j[q] = block.H[0][q] + block.H[second][q] + (has_hoop || in_space ? block.H[components - 1][q] : 0);
      }
    }
  }
  /// Sets dJ to the derivative of j along block.direction.
  static void rate(const Block& block, bool finite_strain, Row& dJ) {
    for (std::size_t q = 0; q < block.count; ++q) dJ[q] = rate_at(block, deformation(block, finite_strain, q), q);
  }
  /// The derivative δJ = cof f : δH at point q.
  static double rate_at(const Block& block, const Tensor& f, std::size_t q) {
    const Tensor cof = cofactor(f);
    double rate = 0;
    for (int c = 0; c < components; ++c) rate += cof[c] * block.direction[c][q];
    return rate;
  }

  /// The deformation gradient f = I + H, at small strain I.
  static Tensor deformation(const Block& block, bool finite_strain, std::size_t q) {
    return plus_identity<K>(finite_strain ? block.H_at(q) : Tensor{});
  }
  /// The cofactor ∂J/∂f = J f⁻ᵀ.
  [[gnu::always_inline]] static Tensor cofactor(const Tensor& f) {
    if constexpr (in_space) {
      return cofactor_of(f, f, 0.5);
    } else if constexpr (has_hoop) {
      const double hoop = f[4];
      return {hoop * f[3], -hoop * f[2], -hoop * f[1], hoop * f[0], f[0] * f[3] - f[1] * f[2]};
    } else {
      return {f[3], -f[2], -f[1], f[0]};
    }
  }
  static Tensor cofactor_rate(const Tensor& f, const Tensor& df) {
    if constexpr (in_space) return cofactor_of(f, df, 1);
    Tensor rate{df[3], -df[2], -df[1], df[0]};
    if constexpr (has_hoop) {
      const Tensor in_plane{f[3], -f[2], -f[1], f[0], 0};
      for (int c = 0; c < 4; ++c) rate[c] = rate[c] * f[4] + in_plane[c] * df[4];
      rate[4] = df[0] * f[3] + f[0] * df[3] - df[1] * f[2] - f[1] * df[2];
    }
    return rate;
  }
  /// Sets block.VP = push cof f. Returns 0, or NaN if some push is not finite.
  static double write_push(Block& block, bool finite_strain, const Row& push) {
    double bad = 0;
    for (std::size_t q = 0; q < block.count; ++q) {
      const Tensor cof = cofactor(deformation(block, finite_strain, q));
      for (int c = 0; c < components; ++c) block.VP[c][q] = push[q] * cof[c];
      bad += 0 * push[q];
    }
    return bad;
  }
  /// V P = scale V P + push cof f at point q.
  [[gnu::always_inline]] static void add_cofactor(Block& block, const Tensor& f, std::size_t q, double scale,
                                                  double push) {
    const Tensor cof = cofactor(f);
    unroll<components>([&](auto c)
                           __attribute__((always_inline)) { block.VP[c][q] = scale * block.VP[c][q] + push * cof[c]; });
  }
  /// V P = V P + push I at point q.
  [[gnu::always_inline]] static void add_identity(Block& block, std::size_t q, double push) {
    unroll<components>([&](auto c) __attribute__((always_inline)) {
      if constexpr (on_diagonal[c]) block.VP[c][q] += push;
    });
  }

 private:
  // share (a_jk b_lm + b_jk a_lm − a_jm b_lk − b_jm a_lk) with i, j, l and n, k, m in cyclic order, at [3 i + n]: for a
  // = b = f and share = ½ it is cof f.
  [[gnu::always_inline]] static Tensor cofactor_of(const Tensor& a, const Tensor& b, double share) {
    Tensor cof;
    unroll<components>([&](auto in) __attribute__((always_inline)) {
      constexpr int i = in / 3, n = in % 3, j = 3 * ((i + 1) % 3), l = 3 * ((i + 2) % 3), k = (n + 1) % 3,
                    m = (n + 2) % 3;
      cof[in] = share * (a[j + k] * b[l + m] + b[j + k] * a[l + m] - a[j + m] * b[l + k] - b[j + m] * a[l + k]);
    });
    return cof;
  }
};

}  // namespace stillpoint

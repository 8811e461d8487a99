// Mean dilatation, F-bar and B-bar: the points of a cell share their change of volume. Material that is nearly
// incompressible, or yields at constant volume, then does not lock: n points of a cell that each keep their volume are
// n constraints on its few nodes, their mean is one. A single mean per cell also suits smooth functions of higher
// degree, which have two unknowns a cell in the plane, whatever their degree: a mean that is linear in each cell would
// be three constraints.
//
// At finite strain, with f = I + H since the phase began, J = det f, and d = 2 in plane strain, 3 if axisymmetric or in
// space,
//
//   f̄_p = s_p f_p,   s_p = (J̄/J_p)^(1/d),   J̄ = Σ V_p J_p/W,   W = Σ V_p over the cell
//                                         [de Souza Neto, Perić, Dutko and Owen 1996; in MPM Coombs et al. 2018].
// The law gives P̄ for f̄. Forces are those of the virtual work Σ V_p P̄_p : δf̄_p, so that a law with a potential
// keeps one and K is as symmetric as the law's moduli [Moran, Ortiz and Shih 1990]:
//
//   V P = s V P̄ + (A V/(W J̄) − a/J) cof f,   a_p = V_p P̄_p : f̄_p/d,   A = Σ a_p.
//
// At small strain [Hughes 1980] this becomes, with J = 1 + tr H to first order:
//
//   H̄ = H + (t̄ − tr H)/d I,   t̄ = Σ V_p tr H_p/W,      V P = V P̄ + (A V/W − a) I,   a_p = V_p tr P̄_p/d.
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "space/kernels/change_of_volume.hpp"

namespace stillpoint {

/// The mean dilatation of one block of points: average(), then the law's stress(), then transform_stress(). A
/// derivative takes these three, followed by average_direction(), the law's tangent(), transform_tangent().
///
/// Means provides the sums over other points, in rows of the block:
///   means(block, x, mean)              x̄ of the state's J − 1 or tr H
///   shares(block, y, share)            Σ_q T_qp y_q of the state's a/J̄
///   rates_of_means(block, x, mean),    the same for their derivatives
///   rates_of_shares(block, y, share)
template <Kinematics K, class Means>
requires(dimensions(K) > 1) class MeanDilatation {
  using Volume = ChangeOfVolume<K>;
  static constexpr int components = Volume::components;
  static constexpr auto on_diagonal = Volume::on_diagonal;
  static constexpr int d = K == Kinematics::plane ? 2 : 3;
  using Block = PointBlock<K>;
  using Row = typename Block::Row;
  using Rows = typename Block::Rows;
  using Tensor = TensorOf<K>;

 public:
  /// finite_strain: whether the law is one of finite strain.
  MeanDilatation(const Means& means, bool finite_strain) : means_(means), finite_(finite_strain) {}

  // A call a block costs nothing; inlined into all callers, these functions took an eighth of a phase's code.

  /// Replaces block.H by H̄.
  [[gnu::noinline]] void average(Block& block) { average_as<false>(block, nullptr, nullptr); }
  /// Replaces block.H by H̄ and block.dH by the part of H̄ since the last commit. before, after: the effect of
  /// averaging on each of the block's points, s_p − 1 or at small strain (t̄ − tr H_p)/d, in the committed state and in
  /// this one; after may be null.
  [[gnu::noinline]] void average(Block& block, const double* before, double* after) {
    average_as<true>(block, before, after);
  }
  /// Writes the effect of averaging on the block's points.
  void write_effect(const Block& block, double* effect) const { std::copy_n(added_.begin(), block.count, effect); }

  /// Transforms block.VP from the law's V P̄ to V P.
  [[gnu::noinline]] void transform_stress(Block& block) {
    pressures(block);
    finite_ ? push_as<true>(block) : push_as<false>(block);
  }

  /// Keeps the parts of V P̄ that a derivative needs; block.VP is unchanged.
  [[gnu::noinline]] void keep_stress(Block& block) {
    pressures(block);
    for_rows(block, [&](int c, std::size_t q) { kept_[c][q] = block.VP[c][q]; });
  }
  /// Transforms block.direction from δH to δH̄.
  [[gnu::noinline]] void average_direction(Block& block) {
    for (std::size_t q = 0; q < block.count; ++q) dJ_[q] = Volume::rate_at(block, deformation(block, q), q);
    means_.rates_of_means(block, dJ_, dmean_);
    for (std::size_t q = 0; q < block.count; ++q) {
      // δs = s/d (δJ̄/J̄ − δJ/J)
      ds_[q] = s_[q] / d * (dmean_[q] * inverse_mean_[q] - dJ_[q] * inverse_J_[q]);
      const Tensor f = deformation(block, q);
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        direction_[c][q] = block.direction[c][q];
        block.direction[c][q] = s_[q] * block.direction[c][q] + ds_[q] * f[c];
      });
    }
  }
  /// Transforms block.VP from the law's V δP̄ to V δP; after keep_stress() and average_direction().
  [[gnu::noinline]] void transform_tangent(Block& block) {
    Row da, given, dshare;
    for (std::size_t q = 0; q < block.count; ++q) {
      const Tensor f = deformation(block, q);
      double sum = 0;
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        sum += block.VP[c][q] * s_[q] * f[c];
        if (finite_) sum += kept_[c][q] * block.direction[c][q];
      });
      da[q] = sum / d;
      given[q] = finite_ ? rate_of_ratio(da[q], a_[q], dmean_[q], inverse_mean_[q]) : da[q];
    }
    means_.rates_of_shares(block, given, dshare);
    for (std::size_t q = 0; q < block.count; ++q) {
      if (!finite_) {
        Volume::add_identity(block, q, dshare[q] - da[q]);
        continue;
      }
      const Tensor f = deformation(block, q);
      const double dpush = dshare[q] - rate_of_ratio(da[q], a_[q], dJ_[q], inverse_J_[q]);
      Volume::add_cofactor(block, f, q, s_[q], dpush);
      Tensor df;
      unroll<components>([&](auto c) __attribute__((always_inline)) { df[c] = direction_[c][q]; });
      const Tensor dcof = Volume::cofactor_rate(f, df);
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        block.VP[c][q] += ds_[q] * kept_[c][q] + push_[q] * dcof[c];
      });
    }
  }

 private:
  template <bool Increments>
  void average_as(Block& block, const double* before, double* after) {
    if (finite_) {
      average_finite<Increments>(block, before);
    } else {
      average_small<Increments>(block, before);
    }
    if (after) write_effect(block, after);
  }
  template <bool Increments>
  void average_finite(Block& block, const double* before) {
    const std::size_t count = block.count;
    Volume::template of_block_as<true>(block, change_);
    means_.means(block, change_, mean_);
#pragma omp simd
    for (std::size_t q = 0; q < count; ++q) {
      const double J = 1 + change_[q], mean = 1 + mean_[q], product = 1 / (J * mean);
      inverse_J_[q] = mean * product;
      inverse_mean_[q] = J * product;
      s_[q] = d == 3 ? std::cbrt(mean * inverse_J_[q]) : mean * std::sqrt(product);
      inverse_s_[q] = d == 3 ? 1 / s_[q] : s_[q] * J * inverse_mean_[q];
      // s − 1 = (J̄ − J)/J/(1 + s [+ s²]),  H̄ = s f − I = s H + (s − 1) I
      const double added = (mean_[q] - change_[q]) * inverse_J_[q] / (1 + s_[q] * (d == 3 ? 1 + s_[q] : 1));
      added_[q] = added;
      const double before_added = Increments ? before[q] : 0;
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        constexpr double one = on_diagonal[c] ? 1 : 0;
        const double f = one + block.H[c][q];
        if constexpr (Increments) block.dH[c][q] = (added - before_added) * f + (1 + before_added) * block.dH[c][q];
        block.H[c][q] = s_[q] * block.H[c][q] + added * one;
      });
    }
  }
  template <bool Increments>
  void average_small(Block& block, const double* before) {
    const std::size_t count = block.count;
    Volume::template of_block_as<false>(block, change_);
    means_.means(block, change_, mean_);
#pragma omp simd
    for (std::size_t q = 0; q < count; ++q) {
      added_[q] = (mean_[q] - change_[q]) / d;
      inverse_J_[q] = inverse_mean_[q] = s_[q] = inverse_s_[q] = 1;
      const double more = Increments ? added_[q] - before[q] : 0;
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        if constexpr (on_diagonal[c] && Increments) block.dH[c][q] += more;
        if constexpr (on_diagonal[c]) block.H[c][q] += added_[q];
      });
    }
  }

  // Sets a, and the factor of cof f, from the law's V P̄.
  void pressures(const Block& block) { finite_ ? pressures_as<true>(block) : pressures_as<false>(block); }
  template <bool Finite>
  void pressures_as(const Block& block) {
    const std::size_t count = block.count;
    Row given;
#pragma omp simd
    for (std::size_t q = 0; q < count; ++q) {
      double work = 0;
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        constexpr double one = on_diagonal[c] ? 1 : 0;
        if constexpr (Finite) work += block.VP[c][q] * (one + block.H[c][q]);
        if constexpr (!Finite && on_diagonal[c]) work += block.VP[c][q];
      });
      a_[q] = work / d;
      given[q] = Finite ? a_[q] * inverse_mean_[q] : a_[q];
    }
    means_.shares(block, given, push_);
#pragma omp simd
    for (std::size_t q = 0; q < count; ++q) push_[q] -= Finite ? a_[q] * inverse_J_[q] : a_[q];
  }

  template <bool Finite>
  void push_as(Block& block) const {
    const std::size_t count = block.count;
#pragma omp simd
    for (std::size_t q = 0; q < count; ++q) {
      if constexpr (Finite) push_finite(block, q);
      if constexpr (!Finite) Volume::add_identity(block, q, push_[q]);
    }
  }

  // Adds the term along cof f = s^(1−d) cof f̄. Separate from the loop: all locals are the function's own, or GCC does
  // not vectorise it.
  [[gnu::always_inline]] void push_finite(Block& block, std::size_t q) const {
    const double push = push_[q] * inverse_s_[q] * (d == 3 ? inverse_s_[q] : 1);
    Volume::add_cofactor(block, plus_identity<K>(block.H_at(q)), q, s_[q], push);
  }

  // The derivative δ(a/J).
  static double rate_of_ratio(double da, double a, double dJ, double inverse_J) {
    return (da - a * dJ * inverse_J) * inverse_J;
  }

  // The f of the averaged block, at small strain I.
  [[gnu::always_inline]] Tensor deformation(const Block& block, std::size_t q) const {
    Tensor f;
    unroll<components>([&](auto c) __attribute__((always_inline)) {
      constexpr double one = on_diagonal[c] ? 1 : 0;
      f[c] = finite_ ? (one + block.H[c][q]) * inverse_s_[q] : one;
    });
    return f;
  }

  template <class Visit>
  [[gnu::always_inline]] static void for_rows(const Block& block, const Visit& visit) {
    for (int c = 0; c < components; ++c) {
      for (std::size_t q = 0; q < block.count; ++q) visit(c, q);
    }
  }

  Means means_;
  const bool finite_;
  alignas(64) Row change_, mean_;  // J − 1 and J̄ − 1 of u, at small strain tr H and t̄
  alignas(64) Row s_, inverse_J_, inverse_mean_, inverse_s_;  // at small strain J = J̄ = s = 1
  alignas(64) Row added_;                                     // s − 1, at small strain (t̄ − tr H)/d
  alignas(64) Row a_, push_;                                  // from V P̄
  alignas(64) Row dJ_, dmean_, ds_;                           // derivatives along δu
  alignas(64) Rows kept_, direction_;                         // V P̄, δH
};

}  // namespace stillpoint

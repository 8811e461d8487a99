// Means over the points of each cell, T_pq = V_q/W: the Means of MeanDilatation for a block of whole cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/lanes.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/materials/point_material.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The sums over cells. A cell with more points than a block holds is summed in parts: it is alone in its block.
template <Kinematics K>
class CellSums {
  using Block = PointBlock<K>;
  using Four = Lanes<4>;

 public:
  using Row = typename Block::Row;
  static constexpr std::size_t slack = 3;  // entries after the last share, for loops that read four at a time

  /// Sets the shares V_p/W of points from … to − 1, W the sum of their volumes.
  static void take_shares(const MaterialPoints<dimensions(K)>& points, std::size_t from, std::size_t to,
                          double* shares) {
    double volume = 0;
    for (std::size_t p = from; p < to; ++p) volume += points.volume[p];
    for (std::size_t p = from; p < to; ++p) shares[p - from] = points.volume[p] / volume;
  }
  /// The shares of all points in their cells, (P + slack), for a phase; a cell in parts has shares in each part by
  /// itself.
  static std::vector<double> volume_shares(const MaterialPoints<dimensions(K)>& points) {
    std::vector<double> shares(points.size() + slack, 0.0);
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (std::size_t from = points.begin(k); from < points.end(k); from += Block::size)
        take_shares(points, from, std::min(from + Block::size, points.end(k)), shares.data() + from);
    }
    return shares;
  }

  /// volume_share: of the block's points, with slack. Both arguments must outlive this object.
  CellSums(const MaterialPoints<dimensions(K)>& points, const double* volume_share)
      : points_(points), volume_share_(volume_share) {}

  // Four points are taken at a time: the next cell overwrites entries written past a cell's end.

  /// The mean Σ V x/W over each cell, at its points.
  [[gnu::always_inline]] void means(const Block& block, const Row& x, Row& mean) const {
    for_cells(
        block, [&](std::size_t from, std::size_t to) __attribute__((always_inline)) {
          const Four of_cell = sum_of(
              from, to, [&](std::size_t q) __attribute__((always_inline)) {
                return Four::load(&x[q]).times(Four::load(volume_share_ + q));
              });
          for (std::size_t q = from; q < to; q += 4) of_cell.store(&mean[q]);
        });
  }
  /// The shares V/W Σ x of the sum over each cell.
  [[gnu::always_inline]] void shares(const Block& block, const Row& x, Row& share) const {
    for_cells(
        block, [&](std::size_t from, std::size_t to) __attribute__((always_inline)) {
          const Four of_cell = sum_of(
              from, to, [&](std::size_t q) __attribute__((always_inline)) { return Four::load(&x[q]); });
          for (std::size_t q = from; q < to; q += 4) of_cell.times(Four::load(volume_share_ + q)).store(&share[q]);
        });
  }
  void rates_of_means(const Block& block, const Row& x, Row& mean) const { means(block, x, mean); }
  void rates_of_shares(const Block& block, const Row& y, Row& share) const { shares(block, y, share); }

 private:
  /// Calls visit(first, last) for each cell's points in the block, by their rows in it.
  template <class Visit>
  [[gnu::always_inline]] void for_cells(const Block& block, const Visit& visit) const {
    std::size_t from = 0;
    for (std::size_t k = block.first_cell; k < block.last_cell; ++k) {
      const std::size_t to = k + 1 < block.last_cell ? points_.end(k) - block.first : block.count;
      visit(from, to);
      from = to;
    }
  }
  // Σ term(q) over from … to − 1, in all lanes; term gives four at a time. Most cells have four points.
  template <class Term>
  [[gnu::always_inline]] static Four sum_of(std::size_t from, std::size_t to, const Term& term) {
    Four sum = term(from);
    if (to - from != 4) {
      sum = sum.first(to - from);
      for (std::size_t q = from + 4; q < to; q += 4) sum = sum.plus(term(q).first(to - q));
    }
    const double in_all = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    const LaneRegister<4>::Type lanes{in_all, in_all, in_all, in_all};
    return {lanes};
  }

  const MaterialPoints<dimensions(K)>& points_;
  const double* volume_share_;
};

template <Kinematics K>
using MeanOverCells = MeanDilatation<K, CellSums<K>>;

extern template class MeanDilatation<Kinematics::plane, CellSums<Kinematics::plane>>;
extern template class MeanDilatation<Kinematics::axisymmetric, CellSums<Kinematics::axisymmetric>>;
extern template class MeanDilatation<Kinematics::space, CellSums<Kinematics::space>>;

}  // namespace stillpoint

// The displacement gradient that a point's law answers to.
#pragma once

#include <array>

#include "space/kernels/mean_dilatation.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

/// H of point p in cell k as its law sees it; u over the grid's functions.
template <AxisBasis B, Kinematics K>
TensorOf<K> law_gradient(const Body<K>& body, const PointWeights<B, K>& weights, [[maybe_unused]] Dilatation dilatation,
                         const double* u, std::size_t k, std::size_t p) {
  if constexpr (dimensions(K) == 2) {
    if (dilatation == Dilatation::cells) {
      const auto& points = body.points;
      const std::size_t part = (p - points.begin(k)) / PointBlock<K>::size;  // of a cell that is more than a block
      PointBlock<K> block;
      block.first_cell = k;
      block.last_cell = k + 1;
      block.first = points.begin(k) + part * PointBlock<K>::size;
      block.count = std::min(PointBlock<K>::size, points.end(k) - block.first);
      for (std::size_t q = 0; q < block.count; ++q) {
        const auto H = weights.gradient(u, k, block.first + q);
        for (std::size_t c = 0; c < H.size(); ++c) block.H[c][q] = H[c];
      }
      const auto& material = *body.materials[static_cast<std::size_t>(points.material_of_cell(k))];
      std::array<double, PointBlock<K>::size + MeanDilatation<K>::slack> share{};
      double volume = 0;
      for (std::size_t q = 0; q < block.count; ++q) volume += points.volume[block.first + q];
      for (std::size_t q = 0; q < block.count; ++q) share[q] = points.volume[block.first + q] / volume;
      MeanDilatation<K>(points, share.data(), material.info().finite_strain).template average<false>(block);
      return block.H_at(p - block.first);
    }
  }
  return weights.gradient(u, k, p);
}

}  // namespace stillpoint

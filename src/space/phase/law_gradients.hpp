// The displacement gradients that the laws of points take.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "space/kernels/cell_sums.hpp"
#include "space/kernels/gather_scatter_bilinear.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/kernels/spline_means.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

/// The averaging by which points share their change of volume, if they do.
template <AxisBasis B, Kinematics K>
struct SharedDilatation {
  bool over_cells = false;
  const SplineMeans<B, K>* splines = nullptr;  // null: not over splines
  std::vector<double> means{};                 // means over the splines, for a displacement
};

/// The gradients point by point. Where points share their change of volume, those of a cell are averaged once for all
/// successive calls.
template <AxisBasis B, Kinematics K>
class LawGradients {
  using Block = PointBlock<K>;

 public:
  /// u: over the grid's functions; shared: for u. All arguments must outlive this object.
  LawGradients(const Body<K>& body, const PointWeights<B, K>& weights, const SharedDilatation<B, K>& shared,
               const double* u)
      : body_(body), weights_(weights), shared_(shared), u_(u) {}

  /// The gradient at point p in occupied cell k.
  TensorOf<K> at(std::size_t k, std::size_t p) {
    if constexpr (dimensions(K) > 1) {
      if (shared_.over_cells || shared_.splines) {
        if (p < block_.first || p >= block_.first + block_.count) average(k, p);
        return block_.H_at(p - block_.first);
      }
    }
    return weights_.gradient(u_, k, p);
  }

 private:
  // Averages the points of cell k, or the part of them that contains p.
  void average(std::size_t k, std::size_t p) {
    const auto& points = body_.points;
    const std::size_t begin = points.begin(k);
    block_.first_cell = k;
    block_.last_cell = k + 1;
    block_.first = begin + (p - begin) / Block::size * Block::size;
    block_.count = std::min(Block::size, points.end(k) - block_.first);
    const std::size_t end = block_.first + block_.count;
    GatherScatter<B, K>::template gather<false>(weights_, k, block_.first, end, u_, nullptr, block_.first, block_.H,
                                                block_.dH);
    const bool finite = body_.materials[static_cast<std::size_t>(points.material_of_cell(k))]->info().finite_strain;
    if (shared_.splines) {
      using Pass = SplinePass<B, K>;
      const Pass pass(*shared_.splines, points.volume.data(), {.means = &shared_.means}, nullptr);
      return MeanDilatation<K, Pass>(pass, finite).average(block_);
    }
    std::array<double, Block::size + CellSums<K>::slack> share{};
    CellSums<K>::take_shares(points, block_.first, end, share.data());
    MeanOverCells<K>({points, share.data()}, finite).average(block_);
  }

  const Body<K>& body_;
  const PointWeights<B, K>& weights_;
  const SharedDilatation<B, K>& shared_;
  const double* u_;
  Block block_;
};

}  // namespace stillpoint

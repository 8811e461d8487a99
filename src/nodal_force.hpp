// Internal nodal forces from the stresses of the material points: the hot loop of every evaluation.
//
//   H_p = Σ_i u_i ⊗ ∇N_ip  →  P_p, by the law of the point  →  R_i = Σ_p V_p P_p ∇N_ip
//
// block by block of points, so that what is between the arrows stays in the first-level cache: cell by cell the nodes'
// displacements are gathered and, after the law, the forces summed into the cell's corners; then corners are summed
// into nodes, each in a fixed order.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "corner_sum.hpp"
#include "parallel_loop.hpp"
#include "point_material.hpp"
#include "point_weights.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class NodalForce {
  using Weights = PointWeights<B, K>;
  using Block = PointBlock<K>;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  static constexpr int rows = Weights::rows;
  static constexpr std::size_t points_for_threads = 8192;  // below, waking threads costs more than it saves

 public:
  /// For the phase of these points and weights, which outlive it or the next rebuild().
  void rebuild(const MaterialPoints<dim>& points, const Weights& weights, std::size_t functions) {
    points_ = &points;
    weights_ = &weights;
    function_of_corner_.resize(per_cell * points.cells());
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (int a = 0; a < per_cell; ++a) function_of_corner_[per_cell * k + a] = weights.function(k, a);
    }
    corner_sum_.rebuild(function_of_corner_, functions);
    corner_.resize(dim * per_cell * points.cells());
    force_.assign(dim * functions, 0.0);
    divide_into_blocks();
  }

  const CornerSum& corner_sum() const { return corner_sum_; }
  const std::vector<double>& force() const { return force_; }

  /// answer(material number, block) turns block.H (and dH where Increments) into block.VP and returns 0, or NaN where
  /// it cannot. u: over the grid's functions; component i at [dim function + i], or with increments at [2 dim function
  /// + i] and du at [2 dim function + dim + i]. False where an answer was NaN. force(): R over the grid.
  template <bool Increments, class Answer>
  bool evaluate(const double* u, const Answer& answer) {
    double bad = 0;
    const std::size_t blocks = blocks_.size();
#pragma omp parallel if (points_->size() > points_for_threads)
    {
      Block block;
#pragma omp for schedule(static) reduction(+ : bad)
      for (std::size_t b = 0; b < blocks; ++b) {
        start(block, b);
        for (std::size_t k = blocks_[b].first_cell; k < blocks_[b].last_cell; ++k) gather<Increments>(k, u, block);
        bad += answer(blocks_[b].material, block);
        for (std::size_t k = blocks_[b].first_cell; k < blocks_[b].last_cell; ++k) scatter(k, block);
      }
      const double* corners = corner_.data();
#pragma omp for schedule(static)
      for (std::size_t f = 0; f < corner_sum_.functions(); ++f) {
        const auto total = corner_sum_.template sum<dim>(f, corners);
        for (int i = 0; i < dim; ++i) force_[dim * f + i] = total[i];
      }
    }
    return bad == 0;
  }

  /// visit(material number, block) with block.H filled, in parallel.
  template <class Visit>
  void visit(const double* u, const Visit& visit) const {
#pragma omp parallel if (points_->size() > points_for_threads)
    {
      Block block;
#pragma omp for schedule(static)
      for (std::size_t b = 0; b < blocks_.size(); ++b) {
        start(block, b);
        for (std::size_t k = blocks_[b].first_cell; k < blocks_[b].last_cell; ++k) gather<false>(k, u, block);
        visit(blocks_[b].material, block);
      }
    }
  }

 private:
  struct BlockOfCells {
    std::size_t first_cell, last_cell;  // one past the last
    std::size_t material;
  };

  // As many whole cells of one material as fit.
  void divide_into_blocks() {
    blocks_.clear();
    std::size_t begin = 0;
    for (std::size_t k = 0; k < points_->cells(); ++k) {
      const auto material = static_cast<std::size_t>(points_->material_of_cell(k));
      const bool fits =
          !blocks_.empty() && blocks_.back().material == material && points_->end(k) - begin <= Block::size;
      if (!fits) {
        blocks_.push_back({k, k, material});
        begin = points_->begin(k);
      }
      blocks_.back().last_cell = k + 1;
    }
  }
  void start(Block& block, std::size_t b) const {
    block.first = points_->begin(blocks_[b].first_cell);
    block.count = points_->begin(blocks_[b].last_cell) - block.first;
  }

  template <bool Increments>
  void gather(std::size_t k, const double* u, Block& block) const {
    constexpr int width = Increments ? 2 * dim : dim;
    std::array<std::array<double, width>, per_cell> of_corner;
    for (int a = 0; a < per_cell; ++a) {
      const double* from = u + width * static_cast<std::ptrdiff_t>(weights_->function(k, a));
      for (int w = 0; w < width; ++w) of_corner[a][w] = from[w];
    }
    const std::size_t begin = points_->begin(k), end = points_->end(k);
    for (std::size_t p = begin; p < end; ++p) {
      const std::size_t q = p - block.first;
      const double* dN = weights_->dN(p);
      std::array<std::array<double, width>, rows> h{};
      for (int a = 0; a < per_cell; ++a) {
        for (int j = 0; j < rows; ++j) {
          for (int w = 0; w < width; ++w) h[j][w] += dN[per_cell * j + a] * of_corner[a][w];
        }
      }
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) {
          block.H[dim * i + j][q] = h[j][i];
          if constexpr (Increments) block.dH[dim * i + j][q] = h[j][dim + i];
        }
      }
      if constexpr (rows > dim) {
        block.H[dim * dim][q] = h[dim][0];
        if constexpr (Increments) block.dH[dim * dim][q] = h[dim][dim];
      }
    }
  }

  // corner_[cell k, a, i] = Σ_p V_p P_ij ∂N_ap/∂x_j over the cell's points
  void scatter(std::size_t k, const Block& block) {
    std::array<std::array<double, per_cell>, dim> force{};
    const std::size_t begin = points_->begin(k), end = points_->end(k);
    for (std::size_t p = begin; p < end; ++p) {
      const std::size_t q = p - block.first;
      const double* dN = weights_->dN(p);
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) {
          const double VP = block.VP[dim * i + j][q];
          for (int a = 0; a < per_cell; ++a) force[i][a] += VP * dN[per_cell * j + a];
        }
      }
      if constexpr (rows > dim) {
        const double VP = block.VP[dim * dim][q];
        for (int a = 0; a < per_cell; ++a) force[0][a] += VP * dN[per_cell * dim + a];
      }
    }
    double* corner = corner_.data() + dim * per_cell * k;
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < dim; ++i) corner[dim * a + i] = force[i][a];
    }
  }

  const MaterialPoints<dim>* points_ = nullptr;
  const Weights* weights_ = nullptr;
  CornerSum corner_sum_;
  std::vector<int> function_of_corner_;  // (cells × per_cell)
  std::vector<BlockOfCells> blocks_;
  std::vector<double> corner_;  // (cells × per_cell × dim) [N]
  std::vector<double> force_;   // (functions × dim) [N]
};

}  // namespace stillpoint

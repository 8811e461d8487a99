// Internal nodal forces from the stresses of the material points: the hot loop of every evaluation.
//
//   H_p = Σ_i u_i ⊗ ∇N_ip  →  P_p, by the law of the point  →  R_i = Σ_p V_p P_p ∇N_ip
//
// block by block of points, so that what is between the arrows stays in the first-level cache: cell by cell the nodes'
// displacements are gathered and, after the law, the forces summed into the cell's corners; then corners are summed
// into nodes, each in a fixed order.
#pragma once

#include <cstddef>
#include <vector>

#include "corner_sum.hpp"
#include "lanes.hpp"
#include "parallel_loop.hpp"
#include "point_material.hpp"
#include "point_weights.hpp"
#include "unroll.hpp"

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
    divide_into_blocks();
  }

  void set_prescribed(std::size_t count) { reactions_.assign(count, 0); }

  const CornerSum& corner_sum() const { return corner_sum_; }
  /// At the prescribed degrees of freedom, of the last evaluation [N].
  const std::vector<double>& reactions() const { return reactions_; }

  /// answer(material number, block) turns block.H (and dH, of u − u_before, where Increments) into block.VP and returns
  /// 0, or NaN where it cannot. u, u_before: over the grid's functions, component i at [dim function + i].
  /// R: forces at the free degrees of freedom, (n); at the prescribed ones they become reactions().
  /// False where an answer was NaN.
  template <bool Increments, class Answer>
  bool evaluate(const double* u, const double* u_before, const Answer& answer, const DegreesOfFreedom& dofs, Vec R) {
    double bad = 0;
    const std::size_t blocks = blocks_.size();
    const int* number = dofs.number.data();
    const int n = static_cast<int>(R.size());
#pragma omp parallel if (points_->size() > points_for_threads)
    {
      Block block;
#pragma omp for schedule(static) reduction(+ : bad)
      for (std::size_t b = 0; b < blocks; ++b) {
        start(block, b);
        for (std::size_t k = blocks_[b].first_cell; k < blocks_[b].last_cell; ++k) {
          gather<Increments>(k, u, u_before, block);
        }
        bad += answer(blocks_[b].material, block);
        for (std::size_t k = blocks_[b].first_cell; k < blocks_[b].last_cell; ++k) scatter(k, block);
      }
      const double* corners = corner_.data();
#pragma omp for schedule(static)
      for (std::size_t f = 0; f < corner_sum_.functions(); ++f) {
        if (!corner_sum_.reaches(f)) continue;
        const auto total = corner_sum_.template sum<dim>(f, corners);
        for (int i = 0; i < dim; ++i) {
          const int dof = number[dim * f + i];
          if (dof >= n) {
            reactions_[static_cast<std::size_t>(dof - n)] = total[i];
          } else if (dof >= 0) {
            R[static_cast<std::size_t>(dof)] = total[i];
          }
        }
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
        for (std::size_t k = blocks_[b].first_cell; k < blocks_[b].last_cell; ++k) gather<false>(k, u, u, block);
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
  void gather(std::size_t k, const double* u, const double* u_before, Block& block) const {
    constexpr int width = Increments ? 2 * dim : dim;  // lanes: u, and u − u_before behind it
    std::array<Lanes<width>, per_cell> of_corner;
    unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
      const auto at = dim * static_cast<std::ptrdiff_t>(weights_->function(k, a));
      const auto now = Lanes<dim>::load(u + at);
      if constexpr (Increments) {
        of_corner[a] = joined(now, now.minus(Lanes<dim>::load(u_before + at)));
      } else {
        of_corner[a] = now;
      }
    });
    const std::size_t begin = points_->begin(k), end = points_->end(k);
    for (std::size_t p = begin; p < end; ++p) {
      const double* dN = weights_->dN(p);
      std::array<Lanes<width>, rows> h{};
      unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
        unroll<rows>([&](auto j) __attribute__((always_inline)) { h[j].add(dN[per_cell * j + a], of_corner[a]); });
      });
      const std::size_t q = p - block.first;
      unroll<dim * dim>([&](auto ij) __attribute__((always_inline)) {
        constexpr int i = ij / dim, j = ij % dim;
        block.H[ij][q] = h[j][i];
        if constexpr (Increments) block.dH[ij][q] = h[j][dim + i];
      });
      if constexpr (rows > dim) {
        block.H[dim * dim][q] = h[dim][0];
        if constexpr (Increments) block.dH[dim * dim][q] = h[dim][dim];
      }
    }
  }

  // corner_[cell k, a, i] = Σ_p V_p P_ij ∂N_ap/∂x_j over the cell's points. Local functions are taken a few at a time;
  // lanes past the last of them read on into what follows, and are dropped.
  void scatter(std::size_t k, const Block& block) {
    constexpr int lanes = per_cell < 4 ? 2 : 4, chunks = (per_cell + lanes - 1) / lanes;
    std::array<std::array<Lanes<lanes>, chunks>, dim> force{};
    const std::size_t begin = points_->begin(k), end = points_->end(k);
    for (std::size_t p = begin; p < end; ++p) {
      const std::size_t q = p - block.first;
      const double* dN = weights_->dN(p);
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
    double* corner = corner_.data() + dim * per_cell * k;
    unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
      unroll<dim>([&](auto i) __attribute__((always_inline)) { corner[dim * a + i] = force[i][a / lanes][a % lanes]; });
    });
  }

  const MaterialPoints<dim>* points_ = nullptr;
  const Weights* weights_ = nullptr;
  CornerSum corner_sum_;
  std::vector<int> function_of_corner_;  // (cells × per_cell)
  std::vector<BlockOfCells> blocks_;
  std::vector<double> corner_;     // (cells × per_cell × dim) [N]
  std::vector<double> reactions_;  // (prescribed degrees of freedom) [N]
};

}  // namespace stillpoint

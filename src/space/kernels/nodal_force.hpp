// Internal nodal forces from the stresses of the material points: the hot loop of every evaluation.
//
//   H_p = Σ_i u_i ⊗ ∇N_ip  →  P_p, by the law of the point  →  R_i = Σ_p V_p P_p ∇N_ip
//
// block by block of points, so that the intermediate values stay in the first-level cache: cell by cell the nodes'
// displacements are gathered and, after the law, the forces summed into the cell's corners; then corners are summed
// into nodes, each in a fixed order.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/parallel_loop.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/kernels/gather_scatter.hpp"
#include "space/kernels/gather_scatter_bilinear.hpp"
#include "space/kernels/gather_scatter_factored.hpp"
#include "space/kernels/gather_scatter_trilinear.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/materials/point_material.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class NodalForce {
  using Weights = PointWeights<B, K>;
  using Block = PointBlock<K>;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  using Cells = GatherScatter<B, K>;
  static constexpr std::size_t points_for_threads = 8192;  // with fewer points, waking threads costs more than it saves

 public:
  /// The arrays that an evaluation writes to, those of a call at a time.
  struct Work {
    std::vector<double> corner;        // (cells × per_cell × dim), and slack [N]
    long corners_at_rest_of = 0;       // the division into blocks whose cells at rest have their forces in `corner`
    std::vector<double> at_extended;   // forces at the extended unknowns [N]
    std::vector<double> at_functions;  // sums at all functions, (functions × dim) [N], where ranks share them
  };

  /// Prepares for the phase of these points, weights and corners, which must outlive it or the next rebuild().
  void rebuild(const MaterialPoints<dim>& points, const Weights& weights, const CornerSum& corner_sum) {
    points_ = &points;
    weights_ = &weights;
    corner_sum_ = &corner_sum;
    divide_into_blocks({});
  }
  /// Lets cells rest in this phase, (cells): their functions do not move, and their forces stay what they are.
  void let_rest(const std::vector<char>& cells) { divide_into_blocks(cells); }
  /// The functions of the cells that move, if some rest.
  const std::vector<std::size_t>& moving_functions() const { return moving_functions_; }
  /// Whether some cells rest whose forces are not in these arrays.
  bool misses_forces_at_rest(const Work& work) const {
    return moving_blocks_ < blocks_.size() && work.corners_at_rest_of != divisions_;
  }

  // Called once a block of up to 128 points, so that the cost of the call is negligible, and the loops around it are
  // compiled once. A lambda that captures more than two words is passed by std::ref(), as it would be copied to the
  // heap otherwise.
  using Answer = std::function<double(std::size_t material, Block& block)>;
  using Visit = std::function<void(std::size_t material, Block& block)>;

  /// Computes forces. answer(material number, block) turns block.H (and dH, for u − u_before, if Increments) into
  /// block.VP and returns 0, or NaN if it cannot. u, u_before and, if Directed, the direction that goes to
  /// block.direction: over the grid's functions, component i at [dim function + i]. R: forces at the free degrees of
  /// freedom, (n); reactions: at the prescribed ones, unless Directed. Cells at rest are answered by at_rest, or keep
  /// the forces that the same arrays have of them if it is null. Returns false if an answer was NaN.
  template <bool Increments, bool Directed = false>
  bool evaluate(const double* u, const double* u_before, const Answer& answer, const Answer* at_rest,
                const DegreesOfFreedom& dofs, Vec R, Vec reactions, Work& work,
                const double* direction = nullptr) const {
    std::atomic<bool> is_answered = true;
    const std::size_t moving = moving_blocks_, blocks = at_rest ? blocks_.size() : moving;
    prepare(dofs, work);
    in_threads(blocks, [&](std::size_t begin, std::size_t end) {
      double bad = 0;
      for_each_block_of_points(begin, end, [&](std::size_t b, Block& block) {
        gather<Increments>(blocks_[b], u, u_before, block, block.H, block.dH);
        if constexpr (Directed) gather<false>(blocks_[b], direction, nullptr, block, block.direction, block.direction);
        bad += b < moving ? answer(blocks_[b].material, block) : (*at_rest)(blocks_[b].material, block);
        scatter(blocks_[b], block, work.corner.data());
      });
      if (bad != 0) is_answered = false;
    });
    const bool is_good = sum_corners<Directed>(dofs, R, reactions, work, is_answered, /*all=*/blocks == blocks_.size());
    if (at_rest) work.corners_at_rest_of = Directed ? 0 : divisions_;
    give_to_sources<Directed>(dofs, R, reactions, work);
    return is_good;
  }

  /// The same with one answer for all cells.
  template <bool Increments, bool Directed = false>
  bool evaluate(const double* u, const double* u_before, const Answer& answer, const DegreesOfFreedom& dofs, Vec R,
                Vec reactions, Work& work, const double* direction = nullptr) const {
    return evaluate<Increments, Directed>(u, u_before, answer, &answer, dofs, R, reactions, work, direction);
  }

  /// As evaluate(), for forces of cells that are known without a law: of_cells(begin, end, corner) writes those of the
  /// occupied cells begin … end − 1, [dim × per_cell] each, and returns 0, or NaN if it cannot.
  template <bool Directed, class OfCells>
  bool evaluate_cells(const OfCells& of_cells, const DegreesOfFreedom& dofs, Vec R, Vec reactions, Work& work) const {
    constexpr std::size_t together = 64;
    const std::size_t cells = points_->cells(), parts = (cells + together - 1) / together;
    std::atomic<bool> is_answered = true;
    prepare(dofs, work);
    work.corners_at_rest_of = 0;
    in_threads(parts, [&](std::size_t begin, std::size_t end) {
      double bad = 0;
      for (std::size_t part = begin; part < end; ++part)
        bad += of_cells(together * part, std::min(together * (part + 1), cells), work.corner.data());
      if (bad != 0) is_answered = false;
    });
    const bool is_good = sum_corners<Directed>(dofs, R, reactions, work, is_answered);
    give_to_sources<Directed>(dofs, R, reactions, work);
    return is_good;
  }

  /// Calls visit(material number, block) with block.H filled (and dH, and direction, as in evaluate()), which it may
  /// change, in parallel.
  template <bool Increments = false, bool Directed = false>
  void visit(const double* u, const Visit& visit, const double* u_before = nullptr,
             const double* direction = nullptr) const {
    in_threads(blocks_.size(), [&](std::size_t begin, std::size_t end) {
      for_each_block_of_points(begin, end, [&](std::size_t b, Block& block) {
        gather<Increments>(blocks_[b], u, u_before, block, block.H, block.dH);
        if constexpr (Directed) gather<false>(blocks_[b], direction, nullptr, block, block.direction, block.direction);
        visit(blocks_[b].material, block);
      });
    });
  }

 private:
  // Calls work(begin, end) for ranges of 0 … n − 1, pieces of the work on all points: a block of points that yields
  // takes longer than one that does not.
  template <class Work>
  void in_threads(std::size_t n, const Work& work) const {
    constexpr std::size_t parts_a_thread = 8;
    if (points_->size() > points_for_threads) {
      in_parts(n, parts_a_thread, work);
    } else {
      work(0, n);
    }
  }
  void prepare(const DegreesOfFreedom& dofs, Work& work) const {
    work.corner.resize(dim * corner_sum_->corners() + CornerSum::slack);
    work.at_extended.assign(dofs.extended.size(), 0.0);
  }
  // Sums the corners' forces into R and reactions. all: those of functions whose cells are all at rest as well. Returns
  // whether all answers were good, those of other ranks too.
  template <bool Directed>
  bool sum_corners(const DegreesOfFreedom& dofs, Vec R, Vec reactions, Work& work, bool is_answered,
                   bool all = true) const {
    const double* corners = work.corner.data();
    const int* number = dofs.number.data();
    const int n = static_cast<int>(R.size()), first_extended = n + static_cast<int>(dofs.prescribed.size());
    const std::size_t count = all ? corner_sum_->functions() : moving_functions_.size();
    const auto take = [&](std::size_t f, const auto& total) __attribute__((always_inline)) {
      for (int i = 0; i < dim; ++i) {
        const int dof = number[dim * f + i];
        if (dof >= first_extended) {
          work.at_extended[static_cast<std::size_t>(dof - first_extended)] = total[i];
        } else if (dof >= n) {
          if constexpr (!Directed) reactions[static_cast<std::size_t>(dof - n)] = total[i];
        } else if (dof >= 0) {
          R[static_cast<std::size_t>(dof)] = total[i];
        }
      }
    };
    if (corner_sum_->shared()) return sum_shared_corners(work, is_answered, take);
    const auto sum = [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t f = all ? k : moving_functions_[k];
        if (corner_sum_->reaches(f)) take(f, corner_sum_->template sum<dim>(f, corners));
      }
    };
    if (!all || points_->size() <= points_for_threads || n == 0) {
      in_threads(count, sum);
      return is_answered;
    }
    // The functions of the unknowns that each thread has in other loops: these are in their order.
    const auto function_of = [&](std::size_t k) {
      return k == 0 ? 0 : k == R.size() ? count : static_cast<std::size_t>(dofs.free[k] / dim);
    };
    in_aligned_parts(R.size(), 1,
                     [&](std::size_t begin, std::size_t end) { sum(function_of(begin), function_of(end)); });
    return is_answered;
  }
  // The same of functions that ranks share: each sums its own, and all take those of all.
  template <class Take>
  bool sum_shared_corners(Work& work, bool is_answered, const Take& take) const {
    std::vector<double>& sums = work.at_functions;
    sums.resize(dim * corner_sum_->functions());
    const bool is_good = corner_sum_->template sum_at_functions<dim>(work.corner.data(), sums.data(), is_answered);
    const std::vector<int>& reached = corner_sum_->shared()->functions_of_all();
    for_each_block(reached.size(), [&](std::size_t k) {
      const auto f = static_cast<std::size_t>(reached[k]);
      take(f, sums.data() + dim * f);
    });
    return is_good;
  }
  template <bool Directed>
  void give_to_sources(const DegreesOfFreedom& dofs, Vec R, Vec reactions, const Work& work) const {
    const std::size_t n = R.size();
    dofs.give_to_sources(work.at_extended, [&](int dof, double force) {
      const auto k = static_cast<std::size_t>(dof);
      if (k < n) {
        R[k] += force;
      } else if constexpr (!Directed) {
        reactions[k - n] += force;
      }
    });
  }

  struct BlockOfCells {
    std::size_t first_cell, last_cell;  // one past the last
    std::size_t material;
  };

  // Makes blocks of as many whole cells of one material as fit, or of one cell that does not fit: first those that
  // move, then those at rest. at_rest: (cells); empty: none is.
  void divide_into_blocks(const std::vector<char>& at_rest) {
    ++divisions_;
    blocks_.clear();
    add_blocks([&](std::size_t k) { return at_rest.empty() || !at_rest[k]; });
    moving_blocks_ = blocks_.size();
    if (at_rest.empty()) return;
    add_blocks([&](std::size_t k) { return at_rest[k] != 0; });
    find_moving_functions(at_rest);
  }
  void find_moving_functions(const std::vector<char>& at_rest) {
    std::vector<char> moves(corner_sum_->functions(), 0);
    for (std::size_t k = 0; k < points_->cells(); ++k) {
      for (int a = 0; a < per_cell && !at_rest[k]; ++a) moves[static_cast<std::size_t>(weights_->function(k, a))] = 1;
    }
    moving_functions_.clear();
    for (std::size_t f = 0; f < moves.size(); ++f)
      if (moves[f]) moving_functions_.push_back(f);
  }
  template <class Takes>
  void add_blocks(const Takes& takes) {
    const std::size_t first = blocks_.size();
    std::size_t begin = 0;
    for (std::size_t k = 0; k < points_->cells(); ++k) {
      if (!takes(k)) continue;
      const auto material = static_cast<std::size_t>(points_->material_of_cell(k));
      const bool fits = blocks_.size() > first && blocks_.back().last_cell == k &&
                        blocks_.back().material == material && points_->end(k) - begin <= Block::size;
      if (!fits) {
        blocks_.push_back({k, k, material});
        begin = points_->begin(k);
      }
      blocks_.back().last_cell = k + 1;
    }
  }
  // Calls work(b, block) for the blocks of cells begin … end − 1.
  template <class Work>
  void for_each_block_of_points(std::size_t begin, std::size_t end, const Work& work) const {
    Block block;
    for (std::size_t b = begin; b < end; ++b) for_each_part(blocks_[b], block, [&] { work(b, block); });
  }
  // Calls work() with as many points in the block as it holds: once, except for a cell that has more.
  template <class Work>
  void for_each_part(const BlockOfCells& cells, Block& block, const Work& work) const {
    const std::size_t end = points_->begin(cells.last_cell);
    block.first_cell = cells.first_cell;
    block.last_cell = cells.last_cell;
    for (block.first = points_->begin(cells.first_cell); block.first < end; block.first += block.count) {
      block.count = std::min(Block::size, end - block.first);
      work();
    }
  }
  // The points of cell k that are in the block, begin to end − 1.
  std::size_t begin(std::size_t k, const Block& block) const { return std::max(points_->begin(k), block.first); }
  std::size_t end(std::size_t k, const Block& block) const {
    return std::min(points_->end(k), block.first + block.count);
  }

  // Computes H, and dH if Increments, for the points in the block.
  template <bool Increments>
  void gather(const BlockOfCells& cells, const double* u, const double* u_before, const Block& block,
              typename Block::Rows& H, typename Block::Rows& dH) const {
    for (std::size_t k = cells.first_cell; k < cells.last_cell; ++k) {
      Cells::template gather<Increments>(*weights_, k, begin(k, block), end(k, block), u, u_before, block.first, H, dH);
    }
  }
  // corner[cell k, a, i] = Σ_p V_p P_ij ∂N_ap/∂x_j over the cell's points.
  void scatter(const BlockOfCells& cells, const Block& block, double* of_all) const {
    constexpr std::size_t corners = dim * per_cell;
    for (std::size_t k = cells.first_cell; k < cells.last_cell; ++k) {
      double* corner = of_all + corners * k;
      if (begin(k, block) == points_->begin(k)) {
        Cells::scatter(*weights_, k, begin(k, block), end(k, block), block, corner);
      } else {
        std::array<double, corners> rest;
        Cells::scatter(*weights_, k, begin(k, block), end(k, block), block, rest.data());
        for (std::size_t c = 0; c < corners; ++c) corner[c] += rest[c];
      }
    }
  }

  const MaterialPoints<dim>* points_ = nullptr;
  const Weights* weights_ = nullptr;
  const CornerSum* corner_sum_ = nullptr;
  std::vector<BlockOfCells> blocks_;
  std::size_t moving_blocks_ = 0;              // the first ones, which are not at rest
  std::vector<std::size_t> moving_functions_;  // those of their cells, if some cells are at rest
  long divisions_ = 0;                         // into blocks, so far
};

}  // namespace stillpoint

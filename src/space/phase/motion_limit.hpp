// How far a phase may take the points: the motion and the strain that end it, and those that a trial may not pass.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

#include "scene/grid_lines.hpp"
#include "space/phase/deformation_from_positions.hpp"
#include "space/phase/internal_force.hpp"
#include "space/phase/phase_frame.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class MotionLimit {
  static constexpr int dim = dimensions(K);
  using Block = PointBlock<K>;

 public:
  /// The arguments must outlive this object.
  MotionLimit(const PhaseFrame<B, K>& frame, const InternalForce<B, K>& force) : frame_(frame), force_(force) {}

  /// Weighs the unknowns of a phase by the motion of points that they cause. by_reach: whether a function that hardly
  /// reaches a point moves none.
  void begin_phase(bool by_reach) {
    std::array<std::vector<double>, dim> per_length;  // of the functions along each axis
    for (std::size_t d = 0; d < dim; ++d) per_length[d] = cells_per_length(d);
    weight_.resize(frame_.size());
    const std::vector<int>& free = frame_.dofs().free;
    for_each_index(weight_.size(), [&, weight = weight_.data(), unknown = free.data()](std::size_t k) {
      const int function = unknown[k] / dim, d = unknown[k] % dim;
      const int along = TensorBasis<B, dim>::index_along(frame_.grid, function, d);
      weight[k] = per_length[static_cast<std::size_t>(d)][static_cast<std::size_t>(along)];
    });
    if (!by_reach) return;
    const std::vector<double> share =
        DeformationFromPositions<B, K>::share_of_motion(frame_.body, frame_.weights, frame_.corner_sum);
    for (std::size_t k = 0; k < weight_.size(); ++k) weight_[k] *= share[static_cast<std::size_t>(free[k] / dim)];
  }

  /// Sets the grid's displacements and returns the largest motion [cells], if it ends the phase, in one pass over the
  /// unknowns.
  double spread_and_measure(double t, ConstVec u, std::vector<double>& grid) const {
    if (spec().ends_by_motion()) return frame_.unknowns.spread_and_measure(t, u, weight_, grid);
    frame_.unknowns.spread(t, u, grid);
    return 0;
  }
  /// The largest |u_i| over a cell's width; no point moves further than the nodes around it if N_i ≥ 0 and Σ N_i = 1.
  double largest_motion(ConstVec u) const {
    return reduce(
        u.size(), 0.0, [u = u.data(), weight = weight_.data()](std::size_t k) { return std::abs(u[k]) * weight[k]; },
        [](double a, double b) { return a > b ? a : b; });
  }
  /// The same of free unknown k alone.
  double motion(std::size_t k, ConstVec u) const { return std::abs(u[k]) * weight_[k]; }
  /// Whether a trial is within the phase: a step past 3/2 of the motion that ends it is too long for the frozen
  /// weights.
  bool allows(double motion, const double* grid_u) const {
    constexpr double share_of_limit = 1.5, cells_if_every_step_remaps = 0.5;
    if (spec().ends_by_motion()) {
      const double allowed = spec().max_motion > 0 ? share_of_limit * spec().max_motion : cells_if_every_step_remaps;
      if (!(motion <= allowed)) return false;
    }
    return !spec().max_strain || largest_strain(grid_u) <= share_of_limit * *spec().max_strain;
  }
  /// The progress of a phase that moves on towards its end at (t, u), which is 1 there.
  double progress(double t, ConstVec u) {
    double share = 0;
    if (spec().ends_by_motion()) {
      const bool committed = frame_.remembers && t == force_.committed().t;
      share = (committed ? force_.committed().motion : largest_motion(u)) / spec().max_motion;
    }
    constexpr long calls_between_looks = 8;  // the strain costs a pass over the points
    if (spec().max_strain && ++looks_ % calls_between_looks == 0) {
      const auto work = force_.borrow();
      frame_.unknowns.spread(t, u, work->u);
      share = std::max(share, largest_strain(work->u.data()) / *spec().max_strain);
    }
    return share;
  }
  void archive(const StateArchive& state) { state("looks", looks_); }

 private:
  const PhaseSpec& spec() const { return frame_.problem.phase; }
  // 1/h for the functions along an axis, (count) [1/m]: h of the narrowest cell in which a function does not vanish or,
  // if the axis is even, of the cells at the start.
  std::vector<double> cells_per_length(std::size_t d) const {
    const Axis& axis = frame_.grid.axes[d];
    const auto count = static_cast<std::size_t>(B::count(axis.cells()));
    if (axis.is_even) return std::vector<double>(count, 1 / mean_cell(frame_.problem.grid, d));
    constexpr int of_cell = B::per_cell - (B::window - 1);  // functions that do not vanish in a cell
    std::vector<double> per_length(count, 0);
    for (int c = 0; c < axis.cells(); ++c) {
      for (int a = 0; a < of_cell; ++a) {
        double& of_function = per_length[static_cast<std::size_t>(B::first(c) + a)];
        of_function = std::max(of_function, 1 / axis.scale_at(c));
      }
    }
    return per_length;
  }
  double largest_strain(const double* grid_u) const {
    double largest = 0;
    std::mutex largest_is_written;
    force_.points().visit(grid_u, [&](std::size_t, const Block& block) {
      double of_block = 0;
      for (const auto& row : block.H) {
        for (std::size_t q = 0; q < block.count; ++q) of_block = std::max(of_block, std::abs(row[q]));
      }
      const std::scoped_lock lock(largest_is_written);
      largest = std::max(largest, of_block);
    });
    return largest_of_all(frame_.ranks, largest);
  }

  const PhaseFrame<B, K>& frame_;
  const InternalForce<B, K>& force_;
  std::vector<double> weight_;  // motion of points per unit of each unknown, at most, in cells, (n) [1/m]
  long looks_ = 0;              // number of times that progress() looked at the strain
};

}  // namespace stillpoint

// The unknowns of a phase, and values over the grid's functions from those of the free unknowns.
#pragma once

#include <stillpoint/types.hpp>

#include <optional>
#include <vector>

#include "space/boundary/boundary_condition.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/extended_functions.hpp"

namespace stillpoint {

/// Values over the grid's functions have component i of function f at [dim f + i].
class PhaseUnknowns {
 public:
  explicit PhaseUnknowns(int dim) : dim_(dim) {}

  /// Begins a phase. reached: whether material reaches a function, (functions).
  void begin_phase(std::vector<char> reached, HeldUnknowns held, const ExtendedFunctions& extension);

  std::size_t size() const { return dofs_->size(); }
  const HeldUnknowns& held() const { return held_; }
  /// As HeldUnknowns::move_on().
  bool move_supports_on(double share) { return held_.move_on(share); }
  const DegreesOfFreedom& dofs() const { return *dofs_; }
  /// Whether neither a support nor a wall holds a function in any component, (functions).
  const std::vector<char>& untouched() const { return untouched_; }

  /// Sets the displacements of all functions from those of the free unknowns, u, and those of the supports at t. grid:
  /// 0 at the others, and at what a support holds without a displacement.
  void spread(double t, ConstVec u, std::vector<double>& grid) const;
  /// Sets the displacements with which the phase begins, from which points are strained: 0, and of what a support holds
  /// HeldUnknowns::from(). The displacement of a support when a run begins is a strain that laws have yet to answer.
  void spread_start(std::vector<double>& grid) const;
  /// The same as spread() in one pass with the largest |u_k| weight_k, which it returns.
  double spread_and_measure(double t, ConstVec u, const std::vector<double>& weight, std::vector<double>& grid) const;
  /// Sets a direction of motion of all functions from that of the free unknowns; supports stay where they are.
  void spread_direction(ConstVec du, std::vector<double>& grid) const;
  /// The velocities of all functions from those of the free unknowns, v, and those of the supports at t.
  std::vector<double> velocities(double t, ConstVec v) const;
  /// The values of the free unknowns, (n).
  std::vector<double> free_values(const std::vector<double>& grid) const;

 private:
  /// Sets the displacements of the unknowns that are neither free nor 0.
  void spread_others(double t, std::vector<double>& grid) const;

  int dim_;
  HeldUnknowns held_;
  std::vector<char> reached_, untouched_;  // (functions)
  std::optional<DegreesOfFreedom> dofs_;
};

}  // namespace stillpoint

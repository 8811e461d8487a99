// The scale of forces relative to which an out-of-balance force is small.
#pragma once

#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// The scale is ‖F‖. If F = 0, or the rounding that remains of a load that returns to zero, it is the largest ‖F‖ or
/// ‖reactions‖ seen so far: the present reactions fall with the out-of-balance force itself when a body is unloaded. If
/// there were none, as in a free body that vibrates, it is the largest ‖R‖.
class ForceScale {
 public:
  /// The scale [N] at an evaluation: loads = ‖F‖, R: (n); trial, contact: the reactions that belong to it.
  double of(double loads, const Vector& R, const TrialState& trial, const Contact* contact) {
    constexpr double rounding = 1e-12;  // relative to the largest load
    const bool is_loaded = loads > rounding * force_;
    force_ = std::max(force_, is_loaded ? loads : reactions(trial, contact));
    if (force_ > 0) return is_loaded ? loads : force_;
    internal_ = std::max(internal_, norm(R));
    return internal_;
  }

  void archive(const StateArchive& state) {
    state("force_scale", force_);
    state("internal_force_scale", internal_);
  }

 private:
  static double reactions(const TrialState& trial, const Contact* contact) {
    const ConstVec of_supports = trial.reactions;
    const double sum = sum_over(of_supports.size(), [=](std::size_t s) { return of_supports[s] * of_supports[s]; });
    return std::sqrt(contact ? contact->squared_forces(sum) : sum);
  }

  double force_ = 0, internal_ = 0;
};

/// ‖Q‖/scale; 0 in balance, even if the scale is 0.
inline double relative(double unbalanced, double scale) { return unbalanced == 0 ? 0 : unbalanced / scale; }

}  // namespace stillpoint

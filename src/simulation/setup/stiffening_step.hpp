// The longest stable step of a material that stiffens as it moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The critical step falls as 1/omega_max. A step h is taken that is below the critical one at u and at u + h v, where
/// it leads. h changes in notches, since an implicit damping is factorised for each new one, and grows back by one at a
/// time, and only a while after it was last shortened: near the critical step a longer one swells the fastest
/// vibrations, these stiffen the body, and the step swings with them for ever unless damping takes in that while what
/// it adds. A collapse would shrink it without end; past 1e-10 the integrator is left to report it.
class StiffeningStep {
 public:
  static constexpr double notch = 1.1;

  /// full_step [s]: what is right where the stiffening is `initial`; n: unknowns of the phase.
  StiffeningStep(const LagrangianPhase& phase, std::size_t n, double full_step, double initial)
      : phase_(phase), full_step_(full_step), initial_(initial), ahead_(n) {}

  /// The step to take from (t, u, v); u, v: (n). Where the stiffness hardly changes on the way ahead, it is looked at
  /// again when that way is done: up to 16 steps later.
  double longest(double t, ConstVec u, ConstVec v) {
    constexpr int most_notches = 242, longest_way = 16, hold = 48;
    constexpr double calm = 0.002;
    if (--steps_until_look_ > 0) return step();
    const double here = phase_.stiffening(t, u);
    const int before = notches_;
    const bool may_grow = ++looks_since_shorter_ > hold;
    double there = 0;
    for (notches_ = std::max(0, notches_ - (may_grow ? 1 : 0)); notches_ < most_notches; ++notches_) {
      there = stiffening_ahead(t, u, v, way_);
      if (step() * std::sqrt(std::max(here, there) / initial_) <= full_step_) break;
    }
    if (way_ > 1 && (notches_ != before || !(std::abs(there - here) <= calm * here))) {
      way_ = 1;
      notches_ = before;
      steps_until_look_ = 0;
      return longest(t, u, v);
    }
    steps_until_look_ = way_;
    if (notches_ > before) looks_since_shorter_ = 0;
    if (std::abs(there - here) <= calm * here) way_ = std::min(2 * way_, longest_way);
    return step();
  }

  void archive(const StateArchive& state) {
    state("notches", notches_, "looks_since_shorter", looks_since_shorter_, "way", way_, "steps_until_look",
          steps_until_look_);
  }

 private:
  double step() const { return full_step_ * std::pow(notch, -notches_); }
  double stiffening_ahead(double t, ConstVec u, ConstVec v, int steps) {
    const double ahead = steps * step();
    for (std::size_t i = 0; i < ahead_.size(); ++i) ahead_[i] = u[i] + ahead * v[i];
    return phase_.stiffening(t + ahead, ahead_);
  }

  const LagrangianPhase& phase_;
  double full_step_, initial_;
  std::vector<double> ahead_;  // u + h v of the steps ahead
  int notches_ = 0;
  int looks_since_shorter_ = 0;
  int way_ = 1, steps_until_look_ = 0;  // [steps]
};

}  // namespace stillpoint

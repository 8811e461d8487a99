// The longest stable step of a material that stiffens as it moves.
#pragma once

#include <stillpoint/lagrangian_phase.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stillpoint {

/// The critical step falls as 1/omega_max. A step h is taken that is below the critical one at u and at u + h v, where
/// it leads. h changes in notches, since an implicit damping is factorised for each new one, and grows back by one at a
/// time. A collapse would shrink it without end; past a ten-thousandth the integrator is left to report it.
class StiffeningStep {
 public:
  static constexpr double notch = 1.1;

  /// full_step [s]: what is right where the stiffening is `initial`; n: unknowns of the phase.
  StiffeningStep(const LagrangianPhase& phase, std::size_t n, double full_step, double initial)
      : phase_(phase), full_step_(full_step), initial_(initial), ahead_(n) {}

  /// The step to take from (t, u, v); u, v: (n).
  double longest(double t, ConstVec u, ConstVec v) {
    constexpr int most_notches = 97;
    const double here = phase_.stiffening(t, u);
    for (notches_ = std::max(0, notches_ - 1); notches_ < most_notches; ++notches_) {
      const double h = full_step_ * std::pow(notch, -notches_);
      for (std::size_t i = 0; i < ahead_.size(); ++i) ahead_[i] = u[i] + h * v[i];
      const double there = phase_.stiffening(t + h, ahead_);
      if (h * std::sqrt(std::max(here, there) / initial_) <= full_step_ * notch) break;
    }
    return full_step_ * std::pow(notch, -notches_);
  }

 private:
  const LagrangianPhase& phase_;
  double full_step_, initial_;
  std::vector<double> ahead_;  // u + h v
  int notches_ = 0;
};

}  // namespace stillpoint

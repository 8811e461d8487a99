// The peak of a kinetic energy that is known at half steps: see kinetic.cpp for the formulas.
#pragma once

#include <stillpoint/scene_options.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>

namespace stillpoint {

class PeakOfEnergy {
 public:
  explicit PeakOfEnergy(Peak place) : place_(place) {}

  /// Begins anew with the present energy alone, at rest or after a velocity was changed from outside.
  void restart(double energy) {
    before_ = 0;
    now_ = energy;
  }
  void advance(double energy) {
    before_ = now_;
    now_ = energy;
  }
  /// Whether the energy `next`, one step later, shows that the peak has been passed.
  bool passed(double next) const { return next < now_; }
  /// The number of steps from the peak to u_n: ½ − s.
  double steps_back(double next) const {
    if (place_ == Peak::half_step) return 0.5;
    const double curvature = before_ - 2 * now_ + next;  // < 0, as next < now and before ≤ now
    return 0.5 - std::clamp(0.5 * (before_ - next) / curvature, -0.5, 0.5);
  }

  void archive(const StateArchive& state) {
    state("energy_before", before_);
    state("energy", now_);
  }

 private:
  Peak place_;
  double before_ = 0, now_ = 0;  // K_0 and K_1, both scaled by any one factor
};

}  // namespace stillpoint

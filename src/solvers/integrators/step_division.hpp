// Equal steps that land on t_stop:  h = (t_stop − t)/m,  m = ⌈(t_stop − t)/max_step⌉.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillpoint {

class StepDivision {
 public:
  explicit StepDivision(double max_step) : max_step_(max_step) {}

  /// The step to take from t; needs t < t_stop. It is the same to the bit until t_stop, and on to the next t_stop if
  /// the intervals differ by no more than the rounding of t: whatever depends on h alone may be kept.
  double step_from(double t, double t_stop) {
    if (t != t_ || t_stop != t_stop_ || remaining_ < 1) divide(t, t_stop);
    return h_;
  }

  /// The time reached by a step of length h from t: t_stop itself after the last of the equal steps.
  double arrive(double t, double h) {
    if (h != h_ || t != t_) {  // a shortened step: the rest of the interval is divided anew
      remaining_ = 0;
      return t + h;
    }
    --remaining_;
    return t_ = remaining_ < 1 ? t_stop_ : t_stop_ - remaining_ * h_;
  }

  void archive(const StateArchive& state) {
    state("h", h_);
    state("t", t_);
    state("t_stop", t_stop_);
    state("remaining", remaining_);
  }

 private:
  void divide(double t, double t_stop) {
    const double way = t_stop - t;
    // An interval longer than m steps by rounding alone is still divided into m steps.
    remaining_ = std::max(1.0, std::ceil(way / max_step_ - 1e-9));
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(t_stop));
    if (std::abs(way - remaining_ * h_) > rounding) h_ = way / remaining_;
    t_ = t;
    t_stop_ = t_stop;
  }

  double max_step_;
  double h_ = 0, t_ = 0, t_stop_ = 0;
  double remaining_ = 0;  // steps that remain: a whole number, as a double because there may be very many
};

}  // namespace stillpoint

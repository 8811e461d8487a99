// A step along p at which the component of the out-of-balance force along p has nearly vanished:
//
//   |Q(u + α p)·p| ≤ σ Q(u)·p
//
// by the secant method on Q·p, inside a bracket once there is one. Q is the negative gradient of the potential energy
// if there is one, and then this is Wolfe's curvature condition; the energy itself is not used, as friction and
// plasticity have none. If Q is linear the secant is exact: two evaluations. Methods whose directions have to stay
// conjugate force that secant by a tiny σ for the first trial.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillpoint {

/// Gives the next α to try; begins with the slope Q·p > 0 at α = 0.
class LineSearch {
 public:
  struct Accuracy {
    double first, later;  // σ of the first trial and of those after it
  };
  /// first: the first α.
  LineSearch(double slope, Accuracy sigma, double first)
      : sigma_(sigma), slope_(slope), last_slope_(slope), alpha_(first) {}

  double alpha() const { return alpha_; }

  /// Called if the trial at alpha() could not be evaluated.
  void refused() {
    upper_ = alpha_;
    alpha_ = (lower_ + alpha_) / 2;
  }

  /// Takes Q·p at alpha(). True if the search is over; else alpha() is the next trial.
  bool done(double slope) {
    ++trials_;
    if (std::abs(slope) <= (trials_ == 1 ? sigma_.first : sigma_.later) * slope_) return true;
    const double secant = alpha_ + (alpha_ - last_) * slope / (last_slope_ - slope);
    (slope > 0 ? lower_ : upper_) = alpha_;
    last_ = alpha_;
    last_slope_ = slope;
    // If secants creep along one end of the bracket, the search goes on from its middle.
    constexpr double longest = 10;
    const double edge = trials_ < 3 ? 0 : 0.01;
    if (!std::isfinite(upper_)) {
      // Without a positive stiffness along p there is no secant to follow: α grows as far as is allowed.
      alpha_ = secant > lower_ ? std::min(secant, longest * lower_) : longest * lower_;
    } else {
      const double width = upper_ - lower_;
      const bool inside = secant > lower_ + edge * width && secant < upper_ - edge * width;
      alpha_ = inside ? secant : (lower_ + upper_) / 2;
    }
    return false;
  }

 private:
  Accuracy sigma_;
  double slope_;  // Q·p at 0
  int trials_ = 0;
  double last_ = 0, last_slope_;                                        // the α before, and Q·p there
  double lower_ = 0, upper_ = std::numeric_limits<double>::infinity();  // the bracket
  double alpha_;
};

}  // namespace stillpoint

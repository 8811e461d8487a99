// A displacement prescribed as a formula in t, with its velocity and acceleration.
#pragma once

#include <stillpoint/expression.hpp>

#include <utility>

namespace stillpoint {

class PrescribedMotion {
 public:
  /// time_scale [s]: about 1/omega_max of the body. A motion that the grid resolves varies over much longer times, and
  /// a kink is spread over about a critical step, so that its impulse is right.
  PrescribedMotion(Expression motion, double time_scale)
      : motion_(std::move(motion)),
        moves_(motion_.uses('t')),
        fixed_(moves_ ? 0 : motion_({}, 0)),
        h_(time_scale / 4) {}

  bool moves() const { return moves_; }
  double displacement(double t) const { return moves_ ? motion_({}, t) : fixed_; }
  /// By central differences of fourth order, off by (h ω)⁴/30 for a motion of frequency ω. If the formula has no
  /// value before t (a root, say), they are taken a little later.
  double velocity(double t) const;
  /// Likewise, off by (h ω)⁴/90.
  double acceleration(double t) const;
  /// The same as a step of central differences of length h sees them, so that it follows the motion exactly and no kink
  /// falls between two steps: (u(t + h) − u(t − h))/(2 h) and (u(t − h) − 2 u(t) + u(t + h))/h².
  double velocity_over(double t, double h) const;
  double acceleration_over(double t, double h) const;

 private:
  Expression motion_;
  bool moves_;
  double fixed_;  // the displacement if it does not move [m]
  double h_;      // [s]
};

}  // namespace stillpoint

// A displacement prescribed as a formula in t, with its velocity and acceleration.
#pragma once

#include <stillpoint/expression.hpp>

namespace stillpoint {

class PrescribedMotion {
 public:
  explicit PrescribedMotion(Expression motion) : motion_(std::move(motion)), moves_(motion_.uses('t')) {}

  bool moves() const { return moves_; }
  double displacement(double t) const { return motion_({}, t); }
  /// By GSL's adaptive central differences: about ten digits for a smooth formula.
  double velocity(double t) const;
  /// By a fourth-order central difference: about eight digits for a formula that varies over seconds.
  double acceleration(double t) const;

 private:
  Expression motion_;
  bool moves_;
};

}  // namespace stillpoint

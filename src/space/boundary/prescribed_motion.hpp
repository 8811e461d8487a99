// A displacement prescribed as a formula in t and position, with its velocity and acceleration.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace stillpoint {

/// A position and the share that the value there has in a mean.
struct WeightedPlace {
  std::vector<double> X;  // [m]; empty: the formula needs none
  double weight = 1;
};

class PrescribedMotion {
 public:
  /// time_scale [s]: about 1/omega_max of the body. A motion that the grid resolves varies over much longer times, and
  /// a kink is spread over about a critical step, so that its impulse is right. X [m]: the position at which the
  /// formula is evaluated, if it depends on position.
  PrescribedMotion(Expression motion, double time_scale, std::vector<double> X = {})
      : motion_(std::make_shared<const Expression>(std::move(motion))),
        places_{{std::move(X), 1}},
        moves_(motion_->uses('t')),
        fixed_(moves_ ? 0 : value(0)),
        h_(time_scale / 4) {}
  /// The same formula at another position, or its weighted sum over several; all share its compiled form.
  PrescribedMotion at(std::vector<double> X) const { return summed_over({{std::move(X), 1}}); }
  PrescribedMotion summed_over(std::vector<WeightedPlace> places) const {
    PrescribedMotion moved = *this;
    moved.places_ = std::move(places);
    if (!moves_) moved.fixed_ = moved.value(0);
    return moved;
  }

  /// The first position.
  const std::vector<double>& position() const { return places_.front().X; }
  bool varies_in_space() const { return motion_->uses_position(); }
  bool moves() const { return moves_; }
  double displacement(double t) const { return moves_ ? value(t) : fixed_; }
  /// The velocity by central differences of fourth order, with the relative error (h ω)⁴/30 for a motion of frequency
  /// ω. If the formula has no value before t (a root, say), they are taken a little later.
  double velocity(double t) const;
  /// The acceleration likewise, with the relative error (h ω)⁴/90.
  double acceleration(double t) const;
  /// Velocity and acceleration by the central differences of a step of length h, so that the step follows the motion
  /// exactly and no kink falls between two steps: (u(t + h) − u(t − h))/(2 h) and (u(t − h) − 2 u(t) + u(t + h))/h².
  double velocity_over(double t, double h) const;
  double acceleration_over(double t, double h) const;

 private:
  double value(double t) const {
    double sum = 0;
    for (const WeightedPlace& place : places_) sum += place.weight * (*motion_)(place.X, t);
    return sum;
  }

  std::shared_ptr<const Expression> motion_;
  std::vector<WeightedPlace> places_;
  bool moves_;
  double fixed_;  // the displacement, if it is constant [m]
  double h_;      // [s]
};

/// Throws SceneError if the motion of a support has no value at the support's position at any time.
void check_motion(std::size_t support, const PrescribedMotion& motion);

}  // namespace stillpoint

// The motion of a rigid body that formulas prescribe.
#pragma once

#include <stillpoint/expression.hpp>

#include <vector>

#include "geometry/rigid_placement.hpp"
#include "space/boundary/prescribed_motion.hpp"

namespace stillpoint {

template <int N>
class RigidMotion {
 public:
  /// translation: u(t), a formula in t a coordinate [m]; rotation: the angle in the plane, counter-clockwise, or the
  /// three components of the rotation vector [rad], about the position `about`, which moves with u. Either may be
  /// empty: there is none. time_scale: see PrescribedMotion. Throws std::invalid_argument for another number of
  /// formulas, or one that varies in space.
  RigidMotion(const std::vector<Expression>& translation, const std::vector<Expression>& rotation,
              const Eigen::Vector<double, N>& about, double time_scale);

  bool moves() const;
  /// Lets the body go a share of its way since `start`, from then on; all of it at first.
  void move_on(double start, double share) {
    start_ = start;
    share_ = share;
  }
  /// Where the body is at t, without velocities.
  RigidPlacement<N> placement(double t) const;
  /// The same with the velocities of PrescribedMotion.
  RigidPlacement<N> at(double t) const;

 private:
  double displacement(const PrescribedMotion& of, double t) const;

  double start_ = 0, share_ = 1;
  std::vector<PrescribedMotion> translation_, rotation_;
  Eigen::Vector<double, N> about_;
};

}  // namespace stillpoint

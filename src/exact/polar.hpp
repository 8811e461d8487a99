// Polar coordinates r, θ around a centre in the plane, for solutions that are expressed in them.
#pragma once

#include <array>
#include <cmath>
#include <span>

namespace stillpoint {

struct PolarPosition {
  double r, cos, sin;  // r [m], cos θ, sin θ

  /// The coordinates of x; at the centre itself θ = 0.
  PolarPosition(std::span<const double> x, const std::array<double, 2>& centre)
      : r(std::hypot(x[0] - centre[0], x[1] - centre[1])),
        cos(r > 0 ? (x[0] - centre[0]) / r : 1),
        sin(r > 0 ? (x[1] - centre[1]) / r : 0) {}

  double cos_2() const { return cos * cos - sin * sin; }
  double sin_2() const { return 2 * sin * cos; }

  /// The components of a vector along x and y.
  std::array<double, 2> cartesian(double along_r, double along_theta) const {
    return {along_r * cos - along_theta * sin, along_r * sin + along_theta * cos};
  }
  /// The components xx, yy, xy of a symmetric tensor.
  std::array<double, 3> cartesian(double rr, double theta_theta, double r_theta) const {
    const double mean = (rr + theta_theta) / 2, half = (rr - theta_theta) / 2;
    return {mean + half * cos_2() - r_theta * sin_2(), mean - half * cos_2() + r_theta * sin_2(),
            half * sin_2() + r_theta * cos_2()};
  }
};

}  // namespace stillpoint

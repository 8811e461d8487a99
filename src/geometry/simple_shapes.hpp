// Rigid shapes with a formula for their signed distance: half-space, ball, box and wedge, and what is outside a shape.
//
// rounding [m]: the radius r of a shape's convex edges and corners. The shape is shrunk by r and grown by r again, the
// opening of mathematical morphology [Serra 1982]: the union of all balls of radius r that lie inside it. Each of these
// shapes, shrunk, is one of its kind, which is convex, so that φ = φ_shrunk − r is exact inside and outside. A
// half-space is its own opening, and so is a ball of a radius of at least r.
//
// Each function throws std::invalid_argument, with one message, if there is no such shape.
#pragma once

#include <limits>

#include "geometry/rigid_shape.hpp"

namespace stillpoint {

/// φ = n·(x − point), n the unit vector along `normal`, which points out of the half-space.
template <int N>
RigidShapePtr<N> half_space(const Eigen::Vector<double, N>& point, const Eigen::Vector<double, N>& normal);

/// A disc or a sphere: φ = |x − centre| − radius.
template <int N>
RigidShapePtr<N> ball(const Eigen::Vector<double, N>& centre, double radius);

/// φ = |x − y| outside, with y_d = min(max(x_d, low_d), high_d), and max_d max(low_d − x_d, x_d − high_d) inside.
template <int N>
RigidShapePtr<N> box(const Eigen::Vector<double, N>& low, const Eigen::Vector<double, N>& high, double rounding = 0);

/// The unbounded wedge of all positions that are seen from the tip at no more than half_angle [rad], between 0 and π/2,
/// from the direction. With s along the direction, ρ ≥ 0 across it and β the half angle,
///
///   φ = ρ cos β − s sin β   beside a flank, where ρ sin β + s cos β ≥ 0,   φ = √(ρ² + s²)   in front of the tip.
///
/// Shrunk by r, its tip moves by r/sin β along the direction.
///
/// With a shaft of radius R it goes on, from where ρ = R, as the strip ρ ≤ R, which has no end. That is convex: inside
/// φ is the larger one of ρ cos β − s sin β and ρ − R, and outside there is another corner between flank and shaft, at
/// ρ = R, s = R/tan β. Shrunk by r, the shaft has the radius R − r.
RigidShapePtr<2> wedge(const Eigen::Vector2d& tip, const Eigen::Vector2d& direction, double half_angle,
                       double rounding = 0, double shaft_radius = std::numeric_limits<double>::infinity());

/// The closed set outside a shape: −φ.
RigidShapePtr<2> outside_of(RigidShapePtr<2> shape);

}  // namespace stillpoint

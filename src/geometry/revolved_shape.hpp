// Rigid bodies of revolution: cylinder, cone, and any profile turned about an axis.
#pragma once

#include <limits>

#include "geometry/rigid_shape.hpp"

namespace stillpoint {

/// The profile turned about the axis through the origin. With z along the axis, r the distance from it, e the unit
/// vector away from it and φ₂(r, z) the signed distance of the profile, which includes its mirror image at r < 0,
///
///   φ = φ₂,   n = ∂φ₂/∂r e + ∂φ₂/∂z a,
///   ∂n/∂x = ∂²φ₂/∂r² e eᵀ + ∂²φ₂/∂r∂z (e aᵀ + a eᵀ) + ∂²φ₂/∂z² a aᵀ + (∂φ₂/∂r)/r (I − a aᵀ − e eᵀ):
///
/// the nearest position of the surface lies in the half plane of x. On the axis (∂φ₂/∂r)/r becomes ∂²φ₂/∂r².
/// Throws std::invalid_argument if the axis has no direction; the other two functions also as box() and wedge() do.
RigidShapePtr<3> revolved(RigidShapePtr<2> profile, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis);

/// from, to: the centres of the two end circles; rounding: of their edges, see box().
RigidShapePtr<3> cylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, double rounding = 0);

/// The unbounded cone, or one that goes on as a shaft; for all arguments see wedge().
RigidShapePtr<3> cone(const Eigen::Vector3d& tip, const Eigen::Vector3d& direction, double half_angle,
                      double rounding = 0, double shaft_radius = std::numeric_limits<double>::infinity());

}  // namespace stillpoint

// The shape that the keys of a rigid body give it.
#pragma once

#include <stillpoint/rigid_spec.hpp>

#include "geometry/rigid_shape.hpp"

namespace stillpoint {

/// The shape of a rigid body in the plane (N = 2) or in space (N = 3) where its keys place it, before its motion.
///
/// axisymmetric: the plane is the half plane (r, z), and the shape is the part at r ≥ 0 of the section of what it makes
/// when it is turned about the axis. What reaches the axis includes its mirror image: a box or a polygon with a side on
/// the axis, a disc or a wedge on it, and what a slanting line cuts off. Whatever else reaches beyond the axis is
/// refused, since it would meet itself.
///
/// Throws std::invalid_argument, with one message, if there is no such shape, or if its STL file is wrong.
template <int N>
RigidShapePtr<N> rigid_shape(const RigidSpec& spec, bool axisymmetric);
template <>
RigidShapePtr<2> rigid_shape<2>(const RigidSpec& spec, bool axisymmetric);
template <>
RigidShapePtr<3> rigid_shape<3>(const RigidSpec& spec, bool axisymmetric);

/// The corners of the shape where its keys place it [m]; where they are rounded, of the shape without a rounding.
std::vector<std::vector<double>> corners_of(const RigidSpec& spec);

}  // namespace stillpoint

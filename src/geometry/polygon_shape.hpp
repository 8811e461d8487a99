// The rigid shape that a simple polygon bounds, convex or not, with its convex corners rounded off or sharp.
#pragma once

#include "geometry/polygon.hpp"
#include "geometry/rigid_shape.hpp"

namespace stillpoint {

/// corners: either way round. rounding [m]: each convex corner is replaced by the arc of radius r that touches its two
/// edges; reflex corners stay as they are. Where the polygon is nowhere narrower than 2 r this is its opening, the
/// union of all discs of radius r that lie inside it; but a narrower neck stays, which an opening would remove.
///
/// The nearest position of the surface, which is found among the parts of edges that arcs leave, the arcs and the sharp
/// corners, tells the side as well: that of the edge, or of the corner's or arc's convex or reflex angle.
///
/// Throws std::invalid_argument if the corners bound no simple polygon, or if an arc does not lie inside it with its
/// disc and both ends on the edges.
RigidShapePtr<2> polygon_shape(const Polygon& corners, double rounding = 0);

/// The polygon in the half plane r ≥ 0 with its mirror image, if it has an edge on the axis r = 0 that joins both; as
/// it is if it has none. Throws std::invalid_argument if it leaves the half plane or has several such edges.
Polygon with_mirror_image(const Polygon& polygon);

}  // namespace stillpoint

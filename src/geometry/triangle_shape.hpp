// The rigid shape that a closed surface of triangles bounds.
#pragma once

#include <memory>
#include <vector>

#include "geometry/rigid_shape.hpp"
#include "geometry/triangle_solid.hpp"

namespace stillpoint {

/// The nearest position y lies in a triangle, on an edge or on a corner, which tells n and ∂n/∂x. In a triangle its
/// normal tells the side. At an edge or a corner no normal of one triangle does; there the solid says if x is inside.
/// The pseudo-normals of Bærentzen and Aanæs (2005) would do as well for a surface without triangles of no area and
/// without edges that four triangles share, as files have them; the solid's answer needs neither.
///
/// n on an edge or a corner itself is the normal of one of its triangles. A triangle without an area has no normal:
/// what is nearest to it is nearest to an edge of a neighbour.
RigidShapePtr<3> triangle_shape(std::shared_ptr<const TriangleSolid> solid);

/// The same for triangles wound one way all over. Throws std::invalid_argument if they are not closed, or enclose no
/// volume.
RigidShapePtr<3> triangle_shape(std::vector<Facet> triangles);

}  // namespace stillpoint

// The surface of a body in space that is no box, for the loads that act there.
#pragma once

#include <stillpoint/problem.hpp>

#include <optional>
#include <string>
#include <vector>

#include "geometry/solid.hpp"

namespace stillpoint {

struct SurfacePiece {
  SpacePoint x;       // [m]
  SpacePoint vector;  // the area vector, outwards [m²]
};

/// The points of Gauss–Legendre rules on a surface that the body has, which is divided into pieces of at most this
/// length [m]. If the body's box cuts off a sphere or a cylinder, the surface ends with the last point in the box; this
/// is exact if the cut goes through the centre or the axis, along axes of coordinates.
std::vector<SurfacePiece> surface_pieces(const BodySpec& body, BodySurface surface, double length);

/// The reason why a body has no such surface; empty if it has one.
std::string why_no_surface(const BodySpec& body, BodySurface surface);

/// The number of the only body of a scene that has another shape than a box; empty if there is none, or more than one.
std::optional<std::size_t> body_with_surface(const Problem& problem);

}  // namespace stillpoint

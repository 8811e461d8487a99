// The surface of a body in space that is no box, for what acts there.
#pragma once

#include <stillpoint/problem.hpp>

#include <optional>
#include <string>
#include <vector>

#include "geometry/solid.hpp"

namespace stillpoint {

struct SurfacePiece {
  SpacePoint x;       // [m]
  SpacePoint vector;  // outwards, as long as the piece is large [m²]
};

/// Of a body that has such a surface: pieces of about this length [m] or shorter, of which each has some points of
/// Gauss and Legendre. Where a body's box cuts a sphere or a cylinder off the surface ends too: with the last piece
/// whose point lies in the box, exactly where the cut goes through the centre or the axis along axes of coordinates.
std::vector<SurfacePiece> surface_pieces(const BodySpec& body, BodySurface surface, double length);

/// Why a body has no such surface; empty: it has it.
std::string why_no_surface(const BodySpec& body, BodySurface surface);

/// The number of the only body of a scene that is another shape than a box; empty if there is none, or more.
std::optional<std::size_t> body_with_surface(const Problem& problem);

}  // namespace stillpoint

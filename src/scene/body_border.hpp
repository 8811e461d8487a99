// The border of a body, for the loads that act there: straight lines in the plane, and in space the surface of one that
// is no box.
#pragma once

#include <stillpoint/problem.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/solid.hpp"

namespace stillpoint {

/// A straight part of the border.
struct BorderLine {
  std::size_t body;                // number of the body, from 0
  std::array<double, 2> from, to;  // [m]
  std::array<double, 2> normal;    // outwards, of length 1
};

/// A side of the box that a body fills; from its lower to its upper end.
BorderLine side_of_box(const Problem& problem, std::size_t body, Face face);

/// The whole border of a body in the plane, with the material on the left of its lines; of points from a file their
/// outline.
std::vector<BorderLine> whole_border(const Problem& problem, std::size_t body);

/// The lines of a traction of a plane scene, on a face of its one body or on a line.
std::vector<BorderLine> border_lines(const Problem& problem, const TractionSpec& traction);

/// The border between two positions, for every body that has both on its border: more than one if bodies touch.
/// The border of a box or a polygon has to be straight there: one line, or none if a corner lies between the ends.
/// Positions within 1e-9 of the body's size count as on a side.
/// For points from a file, the border is the shorter way along their outline, straight or not, between the positions on
/// it that are nearest to the two, which may be a point's spacing off it.
std::vector<BorderLine> border_lines(const Problem& problem, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to);

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

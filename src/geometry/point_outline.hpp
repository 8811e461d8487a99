// The outer surface of a cloud of points in the plane.
#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace stillpoint {

/// Loops that go round the points, holes included, with what they enclose on the left: the border of the Delaunay
/// triangles whose circles are no wider than three points' spacing [Edelsbrunner, Kirkpatrick and Seidel 1983], moved
/// outwards by half a spacing. The outline of a lattice is the border of its squares, except that corners that go
/// inwards are cut off. area: the area of each point [m²], whose root is its spacing. Empty if no triangle is left, as
/// for one or two points, or a row.
std::vector<Polygon> outline_of_points(const std::vector<double>& x, const std::vector<double>& y,
                                       const std::vector<double>& area);

}  // namespace stillpoint

// Plane polygons: corners in order, either way round, with the last joined to the first.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace stillpoint {

using PlanePoint = std::array<double, 2>;
using Polygon = std::vector<PlanePoint>;

double distance(const PlanePoint& a, const PlanePoint& b);
/// The unit normal of the edge from a to b, to its right: outwards if the corners run counter-clockwise.
PlanePoint normal_of_edge(const PlanePoint& a, const PlanePoint& b);
/// Twice the area of the triangle, positive if c is to the left of the edge from a to b.
double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// The area, positive if the corners run counter-clockwise.
double signed_area(const Polygon& polygon);

/// Whether each edge (k: from corner k to the next) is a part of the border: not if another one runs through it the
/// other way, as one that joins a hole to the outline does.
std::vector<char> edges_of_border(const Polygon& polygon);

/// The same without corners at which nothing turns.
Polygon without_straight_corners(const Polygon& polygon);

/// The centroid of a polygon whose area is not 0.
PlanePoint centroid(const Polygon& polygon);

/// True if x is inside. A point on a border that polygons share counts as inside exactly one of them.
bool contains(const Polygon& polygon, const PlanePoint& x);

/// The part in the unit square [Sutherland and Hodgman 1974]. If that has several components, stretches of the square's
/// border that are run through both ways join them: area and centroid are right all the same.
Polygon clipped_to_unit_square(const Polygon& polygon);

/// The area of the part that two simple polygons have in common.
double overlap_area(const Polygon& a, const Polygon& b);

struct PlaceOnBorder {
  double distance = 0;   // from the point x
  std::size_t edge = 0;  // the edge from corner `edge` to the next
  PlanePoint at{};
};
/// The position on the border that is nearest to x.
PlaceOnBorder nearest_on_border(const Polygon& polygon, const PlanePoint& x);
inline double distance_to_border(const Polygon& polygon, const PlanePoint& x) {
  return nearest_on_border(polygon, x).distance;
}

/// The least distance from an edge through the polygon to another one that runs nearly the other way: how wide its
/// narrowest part is. A corner is no such part. Infinite: it has none.
double thinnest_part(const Polygon& polygon);

/// Two edges (k: from corner k to the next) that cross, touch or lie on each other without sharing a corner, or fold
/// back at a shared one; empty if the polygon is simple. A corner equal to its neighbour counts as such edges.
std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const Polygon& polygon);

}  // namespace stillpoint

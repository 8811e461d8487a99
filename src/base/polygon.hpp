// Plane polygons: corners in order, either way round, the last joined to the first.
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
/// Of the edge from a to b, to its right: outwards where the corners run counter-clockwise. Of length 1.
PlanePoint normal_of_edge(const PlanePoint& a, const PlanePoint& b);
/// Twice the area of the triangle, positive if c is to the left of the edge from a to b.
double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Positive if the corners run counter-clockwise.
double signed_area(const Polygon& polygon);

/// Of a polygon with an area.
PlanePoint centroid(const Polygon& polygon);

/// A place on the border counts as inside one of the polygons that share it.
bool contains(const Polygon& polygon, const PlanePoint& x);

/// The part in the unit square [Sutherland and Hodgman 1974]. Where that falls into several, borders of the square that
/// are run through both ways join them: area and centroid are right all the same.
Polygon clipped_to_unit_square(const Polygon& polygon);

/// Of the part that two simple polygons have in common.
double overlap_area(const Polygon& a, const Polygon& b);

struct PlaceOnBorder {
  double distance = 0;   // from where it was looked for
  std::size_t edge = 0;  // from corner `edge` to the next
  PlanePoint at{};
};
/// The place on the border that is nearest to x.
PlaceOnBorder nearest_on_border(const Polygon& polygon, const PlanePoint& x);
inline double distance_to_border(const Polygon& polygon, const PlanePoint& x) {
  return nearest_on_border(polygon, x).distance;
}

/// Two edges (k: from corner k to the next) that cross, touch or lie on each other, though no corner joins them or they
/// fold back at it; empty if the polygon is simple. Corners that repeat their neighbour count as such edges.
std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const Polygon& polygon);

}  // namespace stillpoint

#include "geometry/polygon_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace stillpoint {
namespace {

using Eigen::Vector2d;

/// The part of an edge that the arcs at its ends leave.
struct FlatSide {
  Vector2d from, along, normal;
  double length;
};

/// A sharp corner, or the arc of this radius about a centre. Positions x are nearest to it if x − centre points neither
/// back along the edge before it nor on along the edge after it.
struct Vertex {
  Vector2d centre, before, after;  // unit vectors along the edges
  Vector2d normal;                 // between those of the edges
  double radius;
};

class PolygonShape final : public RigidShape<2> {
 public:
  PolygonShape(std::vector<FlatSide> sides, std::vector<Vertex> vertices, double largest_coordinate)
      : sides_(std::move(sides)), vertices_(std::move(vertices)), largest_coordinate_(largest_coordinate) {}

  // A side reaches a little beyond its ends, and a vertex has to be nearer by more than rounding, so that each x has a
  // side or a vertex, and x beside a corner of 180° a side. Comparisons with NaN skip nothing.
  Nearest<2> nearest(const Position& x) const override {
    const double rounding = rounding_of(largest_coordinate_ + x.lpNorm<1>());
    double least = std::numeric_limits<double>::infinity();
    const FlatSide* side = nullptr;
    const Vertex* vertex = nullptr;
    for (const FlatSide& candidate : sides_) {
      const Vector2d offset = x - candidate.from;
      const double at = offset.dot(candidate.along), distance = std::abs(offset.dot(candidate.normal));
      if (at < -rounding || at > candidate.length + rounding || distance > least) continue;
      least = distance;
      side = &candidate;
    }
    for (const Vertex& candidate : vertices_) {
      const Vector2d offset = x - candidate.centre;
      if (offset.dot(candidate.before) < 0 || offset.dot(candidate.after) > 0) continue;
      const double distance = std::abs(offset.norm() - candidate.radius);
      if (distance > least - rounding) continue;
      least = distance;
      vertex = &candidate;
    }
    if (vertex == nullptr) return nearest_on_face<2>(side->normal.dot(x - side->from), side->normal);
    const Vector2d offset = x - vertex->centre;
    const bool inside = offset.dot(vertex->normal) < 0;
    return grown(nearest_on_feature<2>(offset, Matrix::Zero(), inside, vertex->normal, rounding), vertex->radius);
  }

 private:
  std::vector<FlatSide> sides_;
  std::vector<Vertex> vertices_;
  double largest_coordinate_;
};

Vector2d vector_of(const PlanePoint& x) { return {x[0], x[1]}; }

std::vector<FlatSide> sides_of(const Polygon& polygon) {
  std::vector<FlatSide> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d from = vector_of(polygon[k]), to = vector_of(polygon[(k + 1) % polygon.size()]);
    const Vector2d along = (to - from).normalized();
    edges.push_back({from, along, {along.y(), -along.x()}, (to - from).norm()});
  }
  return edges;
}

/// The vertex between two edges. With α the angle by which the direction turns to the left, an arc of radius r begins
/// r tan(α/2) before the corner.
Vertex vertex_between(FlatSide& before, FlatSide& after, double rounding) {
  Vertex vertex{after.from, before.along, after.along, (before.normal + after.normal).normalized(), 0};
  const double sine = before.along.x() * after.along.y() - before.along.y() * after.along.x();
  if (!(sine > 0)) return vertex;
  const double taken = rounding * std::tan(std::atan2(sine, before.along.dot(after.along)) / 2);
  vertex.centre -= taken * before.along + rounding * before.normal;
  vertex.radius = rounding;
  before.length -= taken;
  after.from += taken * after.along;
  after.length -= taken;
  return vertex;
}

void check(const Polygon& polygon, double rounding) {
  if (polygon.size() < 3) throw std::invalid_argument("a polygon needs three corners at least");
  for (const PlanePoint& x : polygon)
    if (!std::isfinite(x[0]) || !std::isfinite(x[1])) throw std::invalid_argument("a corner is not finite");
  if (const auto crossing = crossing_edges(polygon))
    throw std::invalid_argument(
        fmt::format("the edges after corners {} and {} of the polygon meet or lie on each other", crossing->first + 1,
                    crossing->second + 1));
  if (!(rounding >= 0) || !std::isfinite(rounding))
    throw std::invalid_argument(fmt::format("the rounding {} is not 0 or more", rounding));
}

}  // namespace

RigidShapePtr<2> polygon_shape(const Polygon& corners, double rounding) {
  check(corners, rounding);
  Polygon polygon = corners;
  if (signed_area(polygon) < 0) std::ranges::reverse(polygon);
  const std::size_t n = polygon.size();
  std::vector<FlatSide> sides = sides_of(polygon);
  std::vector<Vertex> vertices;
  double largest_coordinate = 0;
  for (std::size_t k = 0; k < n; ++k) {
    vertices.push_back(vertex_between(sides[(k + n - 1) % n], sides[k], rounding));
    largest_coordinate = std::max({largest_coordinate, std::abs(polygon[k][0]), std::abs(polygon[k][1])});
  }
  constexpr double slack = 1e-9;
  for (std::size_t k = 0; k < n; ++k) {
    const PlanePoint centre{vertices[k].centre.x(), vertices[k].centre.y()};
    const bool disc_lies_inside = distance_to_border(polygon, centre) >= (1 - slack) * vertices[k].radius;
    if (!disc_lies_inside || sides[k].length < -slack * rounding)
      throw std::invalid_argument(fmt::format("the rounding {} is too large for the polygon's corner ({}, {})",
                                              rounding, polygon[k][0], polygon[k][1]));
  }
  return std::make_shared<PolygonShape>(std::move(sides), std::move(vertices), largest_coordinate);
}

Polygon with_mirror_image(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  const auto on_axis = [&](std::size_t k) { return polygon[k % n][0] == 0; };
  std::optional<std::size_t> first;  // the corner at which the polygon leaves the axis
  for (std::size_t k = 0; k < n; ++k) {
    if (polygon[k][0] < 0) throw std::invalid_argument("a polygon reaches beyond the axis of symmetry");
    if (!on_axis(k + n - 1) || !on_axis(k) || on_axis(k + 1)) continue;
    if (first) throw std::invalid_argument("a polygon has several edges on the axis of symmetry, away from each other");
    first = k;
  }
  if (!first) return polygon;
  Polygon whole;
  for (std::size_t k = *first; whole.empty() || !on_axis(k - 1) || !on_axis(k); ++k) whole.push_back(polygon[k % n]);
  for (std::size_t k = whole.size() - 1; k-- > 1;) whole.push_back({-whole[k][0], whole[k][1]});
  return whole;
}

}  // namespace stillpoint

#include "geometry/triangle_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/box_tree.hpp"

namespace stillpoint {
namespace {

using Eigen::Vector3d;

struct FlatTriangle {
  Vector3d normal;
  std::array<Vector3d, 3> corner, along, inwards;  // unit vectors along the edge after each corner, and across it
  std::array<double, 3> length;                    // of the edges
};

FlatTriangle flat_triangle(const Facet& facet) {
  FlatTriangle triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    triangle.corner[k] = Vector3d(facet[k].data());
    const Vector3d edge = Vector3d(facet[(k + 1) % 3].data()) - triangle.corner[k];
    triangle.length[k] = edge.norm();
    triangle.along[k] = edge / triangle.length[k];
  }
  triangle.normal = triangle.along[0].cross(triangle.along[1]).normalized();
  for (std::size_t k = 0; k < 3; ++k) triangle.inwards[k] = triangle.normal.cross(triangle.along[k]);
  return triangle;
}

/// The position of a triangle that is nearest to x.
struct OnTriangle {
  Vector3d offset;  // from it to x
  Vector3d along;   // the direction of the edge that it is on; 0 on a corner
  bool in_face;
};

// Comparisons with NaN lead into the face.
OnTriangle nearest_on(const FlatTriangle& triangle, const Vector3d& x, double rounding) {
  const Vector3d none = Vector3d::Zero();
  bool beside = false;
  for (std::size_t k = 0; k < 3; ++k) beside = beside || triangle.inwards[k].dot(x - triangle.corner[k]) < -rounding;
  if (!beside) return {triangle.normal.dot(x - triangle.corner[0]) * triangle.normal, none, true};
  OnTriangle nearest{Vector3d::Constant(std::numeric_limits<double>::infinity()), none, false};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d offset = x - triangle.corner[k];
    const double at = std::clamp(offset.dot(triangle.along[k]), 0.0, triangle.length[k]);
    const Vector3d from_edge = offset - at * triangle.along[k];
    if (from_edge.squaredNorm() >= nearest.offset.squaredNorm()) continue;
    nearest.offset = from_edge;
    nearest.along = at > 0 && at < triangle.length[k] ? triangle.along[k] : none;
  }
  return nearest;
}

class TriangleShape final : public RigidShape<3> {
 public:
  TriangleShape(std::shared_ptr<const TriangleSolid> solid, std::vector<FlatTriangle> triangles,
                const std::vector<SpaceBox>& boxes)
      : solid_(std::move(solid)), triangles_(std::move(triangles)), tree_(boxes) {
    const auto [low, high] = solid_->bounds();
    for (std::size_t d = 0; d < 3; ++d)
      largest_coordinate_ = std::max({largest_coordinate_, std::abs(low[d]), std::abs(high[d])});
  }

  Nearest<3> nearest(const Position& x) const override {
    const SpacePoint at{x[0], x[1], x[2]};
    const double rounding = rounding_of(largest_coordinate_ + x.lpNorm<1>());
    const FlatTriangle& triangle = triangles_[tree_.nearest(
        at, [&](std::size_t k) { return nearest_on(triangles_[k], x, rounding).offset.squaredNorm(); })];
    const OnTriangle y = nearest_on(triangle, x, rounding);
    if (y.in_face) return nearest_on_face<3>(triangle.normal.dot(x - triangle.corner[0]), triangle.normal);
    const Matrix T = y.along * y.along.transpose();
    return nearest_on_feature<3>(y.offset, T, solid_->contains(at), triangle.normal, rounding);
  }

 private:
  std::shared_ptr<const TriangleSolid> solid_;
  std::vector<FlatTriangle> triangles_;  // those that have an area
  BoxTree tree_;
  double largest_coordinate_ = 0;
};

}  // namespace

RigidShapePtr<3> triangle_shape(std::shared_ptr<const TriangleSolid> solid) {
  constexpr double no_height = 1e-12;  // relative to the first edge
  std::vector<FlatTriangle> triangles;
  std::vector<SpaceBox> boxes;
  for (const Facet& facet : solid->triangles()) {
    const FlatTriangle triangle = flat_triangle(facet);
    const double height = triangle.length[1] * triangle.along[0].cross(triangle.along[1]).norm();
    if (!(height > no_height * triangle.length[0])) continue;
    triangles.push_back(triangle);
    boxes.push_back(box_around(facet));
  }
  return std::make_shared<TriangleShape>(std::move(solid), std::move(triangles), boxes);
}

RigidShapePtr<3> triangle_shape(std::vector<Facet> triangles) {
  if (const auto edge = open_edge(triangles))
    throw std::invalid_argument(fmt::format(
        "the surface is not closed: the edge from ({:.9g}) to ({:.9g}) has no triangle, or one that is wound the other "
        "way, on one of its sides",
        fmt::join(edge->from, ", "), fmt::join(edge->to, ", ")));
  if (triangles.empty() || !(std::abs(signed_volume(triangles)) > 0))
    throw std::invalid_argument("the surface encloses no volume");
  return triangle_shape(std::make_shared<const TriangleSolid>(std::move(triangles)));
}

}  // namespace stillpoint

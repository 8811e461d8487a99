#include "scene/rigid_body.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "base/text.hpp"
#include "geometry/polygon_shape.hpp"
#include "geometry/revolved_shape.hpp"
#include "geometry/simple_shapes.hpp"
#include "geometry/triangle_shape.hpp"
#include "geometry/triangle_solid.hpp"
#include "scene/body_solid.hpp"

namespace stillpoint {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

const double kRounding = rounding_of(1);  // of a component of a unit vector

void require(bool right, const std::string& otherwise) {
  if (!right) throw std::invalid_argument(otherwise);
}

/// What is turned about the axis lies at r ≥ 0, or is symmetric.
void require_beside_axis(bool right, const char* expected) {
  require(right, fmt::format("reaches beyond the axis of symmetry at r = 0; expected {}", expected));
}

template <int N>
Eigen::Vector<double, N> vector_of(const std::vector<double>& x) {
  require(x.size() == N, fmt::format("expected {} coordinates, found {}", N, x.size()));
  return Eigen::Vector<double, N>(x.data());
}

template <int N>
struct TwoPositions {  // or a position and a direction
  Eigen::Vector<double, N> from, to;
};

template <int N>
TwoPositions<N> two_of(const std::vector<std::vector<double>>& list) {
  require(list.size() == 2, fmt::format("expected two positions, or a position and a direction, not {}", list.size()));
  return {vector_of<N>(list[0]), vector_of<N>(list[1])};
}

double half_angle_of(const RigidSpec& spec) { return spec.angle / 2 * std::numbers::pi / 180; }
double shaft_radius_of(const RigidSpec& spec) {
  return spec.radius == 0 ? std::numeric_limits<double>::infinity() : spec.radius;
}

/// What a line in the half plane (r, z) cuts off, turned about the axis. The line meets the axis, unless it is parallel
/// to it, in the tip of a cone: the body is the cone, or what is outside it.
RigidShapePtr<2> half_plane_about_axis(const Vector2d& point, const Vector2d& direction) {
  const Vector2d n = direction.normalized();
  const double side = n[1] > 0 ? 1 : -1;
  const bool parallel = std::abs(n[1]) <= kRounding, across = std::abs(n[0]) <= kRounding;
  require(!parallel || point[0] > 0, fmt::format("a border at r = {} is not beside the axis of symmetry", point[0]));
  if (parallel || across || !n.allFinite()) return half_space<2>(point, direction);
  const Vector2d tip(0, point[1] + n[0] * point[0] / n[1]);
  const double half_angle = std::atan2(std::abs(n[1]), std::abs(n[0]));
  if (n[0] > 0) return wedge(tip, {0, -side}, half_angle);
  return outside_of(wedge(tip, {0, side}, half_angle));
}

RigidShapePtr<2> half_plane_of(const RigidSpec& spec, bool axisymmetric) {
  const auto [point, normal] = two_of<2>(spec.half_plane);
  return axisymmetric ? half_plane_about_axis(point, normal) : half_space<2>(point, normal);
}

RigidShapePtr<2> box_of(const RigidSpec& spec, bool axisymmetric) {
  Vector2d low = vector_of<2>(spec.min);
  const Vector2d high = vector_of<2>(spec.max);
  if (axisymmetric) require_beside_axis(low[0] >= 0, "min[0] of at least 0");
  if (axisymmetric && low[0] == 0) low[0] = -high[0];
  return box<2>(low, high, spec.rounding);
}

RigidShapePtr<2> polygon_of(const RigidSpec& spec, bool axisymmetric) {
  Polygon corners;
  for (const std::vector<double>& corner : spec.polygon) {
    const Vector2d x = vector_of<2>(corner);
    corners.push_back({x[0], x[1]});
  }
  return polygon_shape(axisymmetric ? with_mirror_image(corners) : corners, spec.rounding);
}

RigidShapePtr<2> disc_of(const RigidSpec& spec, bool axisymmetric) {
  const Vector2d centre = vector_of<2>(spec.disc);
  if (axisymmetric)
    require_beside_axis(centre[0] == 0 || centre[0] >= spec.radius, "a centre on the axis, or at least a radius away");
  return ball<2>(centre, spec.radius);
}

/// True if no part of a wedge is at r < 0, and none of its sides on the axis, or if it is symmetric about the axis.
bool is_beside_axis(const Vector2d& tip, const Vector2d& direction, double half_angle, double shaft_radius) {
  const Vector2d along = direction.normalized(), across(-along.y(), along.x());
  if (tip[0] == 0 && std::abs(along[0]) <= kRounding) return true;
  if (tip[0] < 0 || along[0] < -kRounding) return false;
  for (const double side : {-1.0, 1.0}) {
    const double flank = std::cos(half_angle) * along[0] + side * std::sin(half_angle) * across[0];
    const bool is_free = std::isinf(shaft_radius) ? flank > kRounding || (tip[0] > 0 && flank >= -kRounding)
                                                  : tip[0] + shaft_radius / std::sin(half_angle) * flank > 0;
    if (!is_free) return false;
  }
  return true;
}

RigidShapePtr<2> wedge_of(const RigidSpec& spec, bool axisymmetric) {
  const auto [tip, direction] = two_of<2>(spec.wedge);
  const double half_angle = half_angle_of(spec), shaft_radius = shaft_radius_of(spec);
  auto shape = wedge(tip, direction, half_angle, spec.rounding, shaft_radius);
  if (axisymmetric)
    require_beside_axis(is_beside_axis(tip, direction, half_angle, shaft_radius),
                        "tip and direction on the axis, or all of the wedge beside it");
  return shape;
}

RigidShapePtr<3> triangles_of(const RigidSpec& spec) {
  std::vector<Mistake> faults;
  auto solid = read_stl_solid(spec.stl, spec.from_stl, faults);
  if (!solid) throw std::invalid_argument(fmt::format("{} {}", in_quotes(spec.stl.string()), faults.front().message));
  return triangle_shape(std::move(solid));
}

}  // namespace

template <>
RigidShapePtr<2> rigid_shape<2>(const RigidSpec& spec, bool axisymmetric) {
  if (!spec.half_plane.empty()) return half_plane_of(spec, axisymmetric);
  if (!spec.polygon.empty()) return polygon_of(spec, axisymmetric);
  if (!spec.disc.empty()) return disc_of(spec, axisymmetric);
  if (!spec.wedge.empty()) return wedge_of(spec, axisymmetric);
  require(!spec.min.empty() && !spec.max.empty(), "a rigid body in the plane without a shape");
  return box_of(spec, axisymmetric);
}

template <>
RigidShapePtr<3> rigid_shape<3>(const RigidSpec& spec, bool /*axisymmetric*/) {
  if (!spec.half_plane.empty()) {
    const auto [point, normal] = two_of<3>(spec.half_plane);
    return half_space<3>(point, normal);
  }
  if (!spec.sphere.empty()) return ball<3>(vector_of<3>(spec.sphere), spec.radius);
  if (!spec.cylinder.empty()) {
    const auto [from, to] = two_of<3>(spec.cylinder);
    return cylinder(from, to, spec.radius, spec.rounding);
  }
  if (!spec.cone.empty()) {
    const auto [tip, direction] = two_of<3>(spec.cone);
    return cone(tip, direction, half_angle_of(spec), spec.rounding, shaft_radius_of(spec));
  }
  if (!spec.stl.empty()) return triangles_of(spec);
  require(!spec.min.empty() && !spec.max.empty(), "a rigid body in space without a shape");
  return box<3>(vector_of<3>(spec.min), vector_of<3>(spec.max), spec.rounding);
}

std::vector<std::vector<double>> corners_of(const RigidSpec& spec) {
  std::vector<std::vector<double>> corners = spec.polygon;
  for (const auto* const widening : {&spec.wedge, &spec.cone})
    if (!widening->empty()) corners.push_back(widening->front());
  if (spec.from_stl.solid)
    for (const auto& triangle : spec.from_stl.solid->triangles())
      for (const auto& corner : triangle) corners.emplace_back(corner.begin(), corner.end());
  const std::size_t dim = spec.min.size();
  for (std::size_t c = 0; dim > 0 && c < std::size_t{1} << dim; ++c) {
    corners.emplace_back(dim);
    for (std::size_t d = 0; d < dim; ++d) corners.back()[d] = ((c >> d & 1) != 0 ? spec.max : spec.min)[d];
  }
  return corners;
}

}  // namespace stillpoint

#include "scene/body_solid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/prism.hpp"
#include "base/quadric_solid.hpp"
#include "base/triangle_solid.hpp"
#include "scene/outline.hpp"
#include "scene/stl_file.hpp"

namespace stillpoint {
namespace {

SpacePoint point_of(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }

}  // namespace

std::unique_ptr<const Solid> solid_of(const BodySpec& body) {
  if (!body.sphere.empty())
    return std::make_unique<QuadricSolid>(QuadricSolid::sphere(point_of(body.sphere), body.radius, body.inner_radius));
  if (!body.cylinder.empty())
    return std::make_unique<QuadricSolid>(
        QuadricSolid::cylinder(point_of(body.cylinder[0]), point_of(body.cylinder[1]), body.radius, body.inner_radius));
  if (!body.polygon.empty()) {
    const auto axis = static_cast<std::size_t>(body.axis);
    return std::make_unique<Prism>(outline_of(body), axis, body.min[axis], body.max[axis]);
  }
  std::vector<Problem> problems;
  std::vector<Facet> triangles = read_stl_file(body.stl, problems);
  if (!problems.empty()) throw SceneError(std::move(problems));
  return std::make_unique<TriangleSolid>(std::move(triangles));
}

SpaceBox box_of(const BodySpec& body) { return {point_of(body.min), point_of(body.max)}; }

double share_of_box(const BodySpec& body) {
  if (!body.has_shape()) return 1;
  double box = 1;
  for (std::size_t d = 0; d < body.min.size(); ++d) box *= body.max[d] - body.min[d];
  const bool in_plane = body.min.size() == 2;
  return (in_plane ? std::abs(signed_area(outline_of(body))) : volume_in(*solid_of(body), box_of(body))) / box;
}

double volume_in(const Solid& solid, const SpaceBox& box) {
  const SpaceRule rule = solid.rule(box, 0);
  return std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0);
}

}  // namespace stillpoint

#include "scene/body_solid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/gmsh_file.hpp"
#include "geometry/mesh_border.hpp"
#include "geometry/prism.hpp"
#include "geometry/quadric_solid.hpp"
#include "geometry/stl_file.hpp"

namespace stillpoint {
namespace {

SpacePoint point_of(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }

}  // namespace

std::shared_ptr<const Solid> solid_of(const BodySpec& body) {
  const auto axis = static_cast<std::size_t>(body.axis);
  switch (body.shape()) {
    case BodyShape::polygon:
      return std::make_shared<Prism>(outline_of(body), axis, body.min[axis], body.max[axis]);
    case BodyShape::sphere:
      return std::make_shared<QuadricSolid>(
          QuadricSolid::sphere(point_of(body.sphere), body.radius, body.inner_radius));
    case BodyShape::cylinder:
      return std::make_shared<QuadricSolid>(QuadricSolid::cylinder(
          point_of(body.cylinder[0]), point_of(body.cylinder[1]), body.radius, body.inner_radius));
    case BodyShape::triangles:
      return stl_solid(body);
    case BodyShape::box:
    case BodyShape::points:
      break;
  }
  throw std::logic_error("a solid of a body that is a box, or points from a file");
}

std::shared_ptr<const TriangleSolid> read_stl_solid(const std::filesystem::path& file, const StlSolid& known,
                                                    std::vector<Mistake>& problems) {
  if (known.solid && known.file == file) return known.solid;
  const std::size_t before = problems.size();
  std::vector<Facet> triangles = read_stl_file(file, problems);
  if (problems.size() > before) return nullptr;
  return std::make_shared<TriangleSolid>(std::move(triangles));
}

Polygon read_mesh_outline(const BodySpec& body, std::vector<Mistake>& problems) {
  const Mesh mesh = read_gmsh_file(body.mesh, 2, body.group, problems);
  if (mesh.elements.empty()) return {};
  std::string fault;
  std::vector<Polygon> loops = loops_around(mesh, fault);
  if (fault.empty()) return joined(std::move(loops));
  problems.push_back({{body.mesh.string(), 0, 0}, fault});
  return {};
}

std::shared_ptr<const TriangleSolid> read_mesh_solid(const BodySpec& body, std::vector<Mistake>& problems) {
  if (body.from_stl.solid && body.from_stl.file == body.mesh) return body.from_stl.solid;
  const Mesh mesh = read_gmsh_file(body.mesh, 3, body.group, problems);
  if (mesh.elements.empty()) return nullptr;
  std::string fault;
  std::vector<Facet> triangles = surface_of(mesh, fault);
  if (fault.empty()) return std::make_shared<TriangleSolid>(std::move(triangles));
  problems.push_back({{body.mesh.string(), 0, 0}, fault});
  return nullptr;
}

std::shared_ptr<const TriangleSolid> stl_solid(const BodySpec& body) {
  std::vector<Mistake> problems;
  auto solid = body.mesh.empty() ? read_stl_solid(body.stl, body.from_stl, problems) : read_mesh_solid(body, problems);
  if (!solid) throw SceneError(std::move(problems));
  return solid;
}

bool is_solid(const BodySpec& body) { return body.min.size() == 3 && body.has_shape(); }

SpaceBox box_of(const BodySpec& body) { return {point_of(body.min), point_of(body.max)}; }

double share_of_box(const BodySpec& body) {
  if (!body.has_shape()) return 1;
  double box = 1;
  for (std::size_t d = 0; d < body.min.size(); ++d) box *= body.max[d] - body.min[d];
  return (is_solid(body) ? volume_in(*solid_of(body), box_of(body)) : std::abs(signed_area(outline_of(body)))) / box;
}

}  // namespace stillpoint

// The shape of a body: its outline in the plane, and its solid in space if it is no box.
#pragma once

#include <stillpoint/problem.hpp>

#include <filesystem>
#include <memory>
#include <vector>

#include "geometry/polygon.hpp"
#include "geometry/triangle_solid.hpp"

namespace stillpoint {

/// The corners of a polygon in the plane as they are written; for another body those of its box, counter-clockwise,
/// which for points from a file is the box around them.
inline Polygon outline_of(const BodySpec& body) {
  if (body.polygon.empty())
    return {
        {body.min[0], body.min[1]}, {body.max[0], body.min[1]}, {body.max[0], body.max[1]}, {body.min[0], body.max[1]}};
  Polygon outline;
  for (const std::vector<double>& corner : body.polygon) outline.push_back({corner[0], corner[1]});
  return outline;
}

/// The whole solid of a body that is neither a box nor points. The body is the part in the box from body.min to
/// body.max; a prism begins and ends there. Throws SceneError if a file of triangles is wrong, std::logic_error for
/// another body.
std::shared_ptr<const Solid> solid_of(const BodySpec& body);

/// The solid that the surface in an STL file encloses: `known`, if that is of this file, or read now; null with a
/// problem if the file is wrong.
std::shared_ptr<const TriangleSolid> read_stl_solid(const std::filesystem::path& file, const StlSolid& known,
                                                    std::vector<Mistake>& problems);
/// The border of body.mesh, in the plane as a polygon, in which a line that is run through both ways is none of the
/// border, and in space as a solid; empty or null with a problem if the file is wrong.
Polygon read_mesh_outline(const BodySpec& body, std::vector<Mistake>& problems);
std::shared_ptr<const TriangleSolid> read_mesh_solid(const BodySpec& body, std::vector<Mistake>& problems);
/// That of the file body.stl or body.mesh; throws SceneError if the file is wrong.
std::shared_ptr<const TriangleSolid> stl_solid(const BodySpec& body);

/// True for a body in space that is no box, so that cells may be partly inside it.
bool is_solid(const BodySpec& body);

SpaceBox box_of(const BodySpec& body);

/// The share that a body covers of its box, in the plane or in space.
double share_of_box(const BodySpec& body);

}  // namespace stillpoint

// The shape of a body in space that is no box.
#pragma once

#include <stillpoint/problem.hpp>

#include <memory>
#include <vector>

#include "geometry/triangle_solid.hpp"

namespace stillpoint {

/// All of it; the body is what of it lies in the box from body.min to body.max, which for a prism says where it begins
/// and ends. Throws SceneError if a file of triangles is wrong, std::logic_error for a body that is a box or points.
std::shared_ptr<const Solid> solid_of(const BodySpec& body);

/// What the file body.stl encloses: as body.from_stl has it, or read. Without it the problems say what is wrong.
std::shared_ptr<const TriangleSolid> read_stl_solid(const BodySpec& body, std::vector<Mistake>& problems);
/// The same. Throws SceneError.
std::shared_ptr<const TriangleSolid> stl_solid(const BodySpec& body);

/// Whether it is a body in space that is no box, of which cells may have a part.
bool is_solid(const BodySpec& body);

SpaceBox box_of(const BodySpec& body);

/// The share that a body covers of its box, in the plane or in space.
double share_of_box(const BodySpec& body);

}  // namespace stillpoint

// The shape of a body in space that is no box.
#pragma once

#include <stillpoint/scene.hpp>

#include <memory>

#include "base/solid.hpp"

namespace stillpoint {

/// All of it; the body is what of it lies in the box from body.min to body.max, which for a prism says where it begins
/// and ends. Throws SceneError if a file of triangles is wrong.
std::unique_ptr<const Solid> solid_of(const BodySpec& body);

SpaceBox box_of(const BodySpec& body);

/// The share that a body covers of its box, in the plane or in space.
double share_of_box(const BodySpec& body);

/// [m³]
double volume_in(const Solid& solid, const SpaceBox& box);

}  // namespace stillpoint

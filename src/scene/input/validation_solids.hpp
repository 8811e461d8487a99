// Shapes of bodies in space, and corners of polygons.
#pragma once

#include <cstddef>
#include <string>

#include "scene/input/scene_check.hpp"

namespace stillpoint {

/// Keys of a shape that exclude each other, or need one another. table: "body", "body[1]".
void check_shape_keys(SceneCheck& check, const std::string& table);

/// Whether a key says that the body is neither a box nor points from a file.
bool has_shape_key(const SceneCheck& check, std::size_t k);

/// True if the corners are those of a simple polygon with an area.
bool check_corners(SceneCheck& check, std::size_t k);

/// True if the shape, cut off where min or max is written, has a volume in the grid; its box is then body.min and
/// body.max. These are in order.
bool check_solid(SceneCheck& check, std::size_t k);

}  // namespace stillpoint

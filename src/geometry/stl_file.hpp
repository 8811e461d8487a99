// A closed surface of triangles from an STL file, binary or ASCII; normals are not read, since corners have an order.
#pragma once

#include <stillpoint/scene_error.hpp>

#include <filesystem>
#include <vector>

#include "geometry/triangle_solid.hpp"

namespace stillpoint {

/// What is wrong goes to problems, one of a file: of an ASCII file with its line and column. Without one the triangles
/// are closed, wound one way all over, either way round, and enclose a volume.
std::vector<Facet> read_stl_file(const std::filesystem::path& file, std::vector<Mistake>& problems);

}  // namespace stillpoint

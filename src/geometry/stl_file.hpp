// A closed surface of triangles from an STL file, binary or ASCII; normals are not read, since corners have an order.
#pragma once

#include <stillpoint/scene_error.hpp>

#include <filesystem>
#include <vector>

#include "geometry/triangle_solid.hpp"

namespace stillpoint {

/// The triangles of a file. A fault goes to problems, at most one for a file, with line and column if the file is
/// ASCII. Without a fault, the triangles are closed, wound one way all over, either way round, and enclose a volume.
std::vector<Facet> read_stl_file(const std::filesystem::path& file, std::vector<Mistake>& problems);

}  // namespace stillpoint

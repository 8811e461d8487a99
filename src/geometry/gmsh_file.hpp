// A mesh from a file of Gmsh's, as text in its formats 4.1 and 2.2.
#pragma once

#include <stillpoint/scene_error.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "geometry/solid.hpp"

namespace stillpoint {

struct MeshElement {
  int kind;                        // Gmsh's number of it: 2 a triangle, 4 a tetrahedron, …
  std::vector<std::size_t> nodes;  // in Gmsh's order, by their tags
};

struct Mesh {
  std::unordered_map<std::size_t, SpacePoint> nodes;  // by their tags [m]
  std::vector<MeshElement> elements;
};

/// The elements of so many dimensions, 2 or 3, in the physical group of this name; all of them if it is empty. A fault
/// goes to problems, at most one for a file, with line and column if it is in the text; the mesh is empty then.
Mesh read_gmsh_file(const std::filesystem::path& file, int dim, const std::string& group,
                    std::vector<Mistake>& problems);

}  // namespace stillpoint

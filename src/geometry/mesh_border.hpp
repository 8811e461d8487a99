// What encloses the elements of a mesh: their sides that no other element shares.
#pragma once

#include <string>
#include <vector>

#include "geometry/gmsh_file.hpp"
#include "geometry/polygon.hpp"
#include "geometry/triangle_solid.hpp"

namespace stillpoint {

/// The border of a mesh in the plane: closed loops with the material on their left, so that holes run clockwise. Sides
/// of elements of order 2 are two lines each. fault: what is wrong, in words, if there are no loops.
std::vector<Polygon> loops_around(const Mesh& mesh, std::string& fault);

/// Loops as one polygon: lines that are run through both ways join each to one before it, and enclose nothing. They
/// touch no loop but at their ends.
Polygon joined(std::vector<Polygon> loops);

/// The surface of a mesh in space, closed, its triangles counter-clockwise seen from outside.
std::vector<Facet> surface_of(const Mesh& mesh, std::string& fault);

}  // namespace stillpoint

// The whole border of a body, cut into pieces and patches.
//
// In a single phase the border is cut at the grid lines, with a Gauss rule in each part; in later phases the pieces are
// the outer faces of domains, two to a face, or positions that material points carry, one to a point. A patch is the
// pieces along a cell, or a domain: what the grid's functions can tell apart. Shorter ones are joined.
#pragma once

#include <array>
#include <vector>

#include "space/boundary/border_piece.hpp"
#include "space/boundary/face_end.hpp"

namespace stillpoint {

template <Kinematics K>
struct BorderPatch {
  double cell;   // the width of its cell, in space ∛(volume) [m]
  double depth;  // thickness, or 2 π r if axisymmetric [m]; 1 in space
  std::vector<BorderPiece<K>> pieces;
  // In the plane:
  int of_cell = -1;               // the number of the cell that it borders when it is placed
  bool goes_on = false;           // the patch before goes on with this one, without a corner
  bool closes = false;            // the border goes on with the first patch of those
  std::array<FaceEnd, 2> ends{};  // where the border begins and ends with this patch
};

/// body: its number in the scene; a line has no border. grid: that of the first phase.
template <Kinematics K>
std::vector<BorderPatch<K>> border_patches(const Problem& problem, std::size_t body, const Grid<dimensions(K)>& grid);

}  // namespace stillpoint

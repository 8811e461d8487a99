// Two kinds of supports: those that prescribe unknowns of the grid, and those that hold the body by springs.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <vector>

#include "scene/grid_lines.hpp"

namespace stillpoint {

/// True if the basis has a value of its own at each node; otherwise it has one only at the ends of the grid.
inline bool has_nodal_values(BasisKind basis) { return basis == BasisKind::linear || basis == BasisKind::hermite; }

/// True if a support holds by springs: if its scene gives a stiffness, or if the basis has no value of its own at the
/// support, so that no unknown can be prescribed. The grid has to be in order.
inline bool holds_by_springs(const GridSpec& grid, const SupportSpec& support) {
  if (support.stiffness) return true;
  if (support.face) return support.on_part() && !has_nodal_values(grid.basis);
  for (std::size_t axis = 0; axis < support.at.size(); ++axis) {
    const double x = support.at[axis];
    const bool at_end = nearest_line(grid, axis, x) % grid.cells[axis] == 0;
    if (!is_on_line(grid, axis, x) || !(at_end || has_nodal_values(grid.basis))) return true;
  }
  return false;
}

/// The extent of a part of a face along one of its axes [m].
struct FaceInterval {
  std::size_t along = 0;  // the axis
  double from = 0, to = 0;
};
/// The part of the face of a box from min to max: an interval along each axis but the normal's, in the order of the
/// axes. If from or to is empty, the part reaches to the end of the face.
inline std::vector<FaceInterval> part_of_face(Face face, const std::vector<double>& from, const std::vector<double>& to,
                                              const std::vector<double>& min, const std::vector<double>& max) {
  std::vector<FaceInterval> part;
  for (std::size_t axis = 0; axis < min.size(); ++axis) {
    if (axis == static_cast<std::size_t>(axis_of(face))) continue;
    const std::size_t k = part.size();
    part.push_back({axis, from.empty() ? min[axis] : from[k], to.empty() ? max[axis] : to[k]});
  }
  return part;
}
/// The part of a face of the grid that a support holds.
inline std::vector<FaceInterval> held_part(const GridSpec& grid, const SupportSpec& support) {
  return part_of_face(*support.face, support.from, support.to, grid.min, grid.max);
}

}  // namespace stillpoint

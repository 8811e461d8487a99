// The free surface of a granular mass in the plane, and the angle of its slope.
#pragma once

#include <stillpoint/types.hpp>

#include <vector>

namespace stillpoint {

/// The positions of the points on the surface, from left to right: one in each column that has any.
struct FreeSurface {
  std::vector<double> x, y;  // [m]
};

/// The highest point of the mass in each column k w ≤ x < (k + 1) w. position: (points × 2) row by row [m]; w > 0 [m]:
/// the length of a cell, in which there should be a point wherever there is mass.
///
/// The mass is the largest cluster of points: squares of side w that contain points belong together if they touch, even
/// at a corner. Points that flew off and positions that are not finite therefore do not count.
///
/// The surface is drawn through its points. The material of a point reaches half a spacing further, but deformed points
/// have no single spacing, and a shift of the whole surface changes no slope.
FreeSurface free_surface(ConstVec position, double w);

/// The angle between the slope and the horizontal [degrees], 0 … 90 whichever way it falls, of the straight line
/// nearest to the surface between 15 % and 85 % of the height H = max y − base. NaN if there are fewer than 3 columns.
///
/// One flank is evaluated: from the highest position outwards for as long as the surface is above 15 % of H, to the
/// side that has more columns between the two heights (if equal, the right one).
///
/// The line minimises Σ (distance across the line)²: a point of the surface lies up to a spacing inside the mass,
/// across the slope. The vertical distances of y(x) grow like 1/cos of the angle, and those that the limits of height
/// cut off would flatten a steep slope.
double slope_angle(const FreeSurface& surface, double base);

}  // namespace stillpoint

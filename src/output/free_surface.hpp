// The free surface of a granular mass in the plane, and the angle of its slope.
#pragma once

#include <stillpoint/types.hpp>

#include <vector>

namespace stillpoint {

/// Places of the points that lie on the surface, from left to right: one in each column that has any.
struct FreeSurface {
  std::vector<double> x, y;  // [m]
};

/// The highest point of the mass in each column k w ≤ x < (k + 1) w. position: (points × 2) row by row [m]; w > 0 [m]:
/// the length of a cell, in which there should be a point wherever there is mass.
///
/// The mass is the largest cluster of points: squares of side w with points in them belong together if they touch,
/// be it by a corner. So points that flew off, above it or beyond it, do not count, nor do positions that are not
/// finite.
///
/// The surface is drawn through its points. What a point stands for reaches half a spacing further, but deformed points
/// have no one spacing, and a shift of the whole surface changes no slope.
FreeSurface free_surface(ConstVec position, double w);

/// The angle of the slope against the horizontal [degrees], 0 … 90 whichever way it falls, of the straight line nearest
/// to the surface between 15 % and 85 % of the height H = max y − base. NaN if fewer than 3 columns are there.
///
/// One flank is looked at: from the highest position outwards for as long as the surface is above 15 % of H, to the
/// side that has more columns between the two heights (of equals, the right one).
///
/// The line makes Σ (distance across the line)² least: a point of the surface lies up to a spacing inside the mass,
/// across the slope. The vertical distances of y(x) grow like 1/cos of the angle, and those that the limits of height
/// cut off would flatten a steep slope.
double slope_angle(const FreeSurface& surface, double base);

}  // namespace stillpoint

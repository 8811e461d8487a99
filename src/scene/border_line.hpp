// A straight part of a body's border, for the loads that act there.
#pragma once

#include <stillpoint/problem.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace stillpoint {

struct BorderLine {
  std::size_t body;                // number of the body, from 0
  std::array<double, 2> from, to;  // [m]
  std::array<double, 2> normal;    // outwards, of length 1
};

/// A side of the box that a body fills; from its lower to its upper end.
BorderLine side_of_box(const Problem& problem, std::size_t body, Face face);

/// The lines of a traction of a plane scene, on a face of its one body or on a line.
std::vector<BorderLine> border_lines(const Problem& problem, const TractionSpec& traction);

/// The border between two positions, for every body that has both on its border: more than one if bodies touch.
/// The border of a box or a polygon has to be straight there: one line, or none if a corner lies between the ends.
/// Positions within 1e-9 of the body's size count as on a side.
/// For points from a file, the border is the shorter way along their outline, straight or not, between the positions on
/// it that are nearest to the two, which may be a point's spacing off it.
std::vector<BorderLine> border_lines(const Problem& problem, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to);

}  // namespace stillpoint

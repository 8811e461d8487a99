// A straight part of a body's border, for what acts there.
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

/// Those of a traction of a plane scene, on a face of its one body or on a line.
std::vector<BorderLine> border_lines(const Problem& problem, const TractionSpec& traction);

/// The border between two positions on it, of every body that has both: of more than one where bodies touch.
/// Of a box or a polygon it is straight: one line, or none where a corner lies between the ends. Positions count as on
/// a side that is within 1e-9 of the body's size.
/// Of points from a file it is the shorter way along their outline, straight or not, between the places next to the
/// two positions, which may be a point's spacing off it.
std::vector<BorderLine> border_lines(const Problem& problem, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to);

}  // namespace stillpoint

// A straight part of a body's border, for what acts there.
#pragma once

#include <stillpoint/scene.hpp>

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
BorderLine side_of_box(const Scene& scene, std::size_t body, Face face);

/// That of a traction of a plane scene, on a face of its one body or on a line.
BorderLine border_line(const Scene& scene, const TractionSpec& traction);

/// Of every body of which one straight side, of a box or of a polygon, holds both ends: two where bodies touch, none
/// where a corner lies between the ends. Positions count as on a side that is within 1e-9 of the body's size.
std::vector<BorderLine> border_lines(const Scene& scene, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to);

}  // namespace stillpoint

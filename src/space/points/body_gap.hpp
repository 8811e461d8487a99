// The gap between two bodies that share functions of the grid.
#pragma once

#include <array>
#include <cstddef>

namespace stillpoint {

/// The gap between bodies a < b of a scene.
struct BodyGap {
  std::size_t a = 0, b = 0;
  double gap = 0;    // the smallest distance [m]; 0 if they touch
  double cells = 0;  // the same distance in cells
};

/// The axes along which a body is held.
using HeldAxes = std::array<bool, 3>;

}  // namespace stillpoint

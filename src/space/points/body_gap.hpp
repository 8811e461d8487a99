// How far two bodies that share functions of the grid are apart.
#pragma once

#include <array>
#include <cstddef>

namespace stillpoint {

/// Bodies a < b of a scene.
struct BodyGap {
  std::size_t a = 0, b = 0;
  double gap = 0;    // the least between them [m]; 0 if they touch
  double cells = 0;  // the same in cells
};

/// Along which axes something holds a body.
using HeldAxes = std::array<bool, 3>;

}  // namespace stillpoint

// Reports of walls.
#pragma once

#include <array>
#include <string>

namespace stillpoint {

/// The force of the body on a rigid wall [N]: along the wall's outward normal, and along the other axes in order, one
/// in the plane and two in space.
struct WallReaction {
  std::string name;
  int axis = 0;  // axis of the normal
  double normal = 0;
  std::array<double, 2> shear{};
  double power = 0;            // power of the wall on the body [W]
  double displacement = 0;     // displacement of the wall [m]
  double furthest_behind = 0;  // largest distance so far behind the prescribed motion [m]
  double put_back = 0;         // largest distance so far by which a node has been put back onto the wall [m]
};

}  // namespace stillpoint

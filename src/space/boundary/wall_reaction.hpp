// What walls report.
#pragma once

#include <array>
#include <string>

namespace stillpoint {

/// What a rigid wall feels from the body: along its outward normal, and along the other axes in their order, of which
/// there is one in the plane and there are two in space [N].
struct WallReaction {
  std::string name;
  int axis = 0;  // of the normal
  double normal = 0;
  std::array<double, 2> shear{};
  double power = 0;            // of the wall on the body [W]
  double displacement = 0;     // of the wall [m]
  double furthest_behind = 0;  // the furthest so far that it has been behind its prescribed motion [m]
  double put_back = 0;         // the furthest so far that a node has been put back onto it [m]
};

}  // namespace stillpoint

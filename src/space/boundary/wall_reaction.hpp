// What walls report.
#pragma once

#include <string>

namespace stillpoint {

/// What a rigid wall feels from the body: along its outward normal, and along the face's coordinate [N].
struct WallReaction {
  std::string name;
  double normal = 0, shear = 0;
  double power = 0;         // of the wall on the body [W]
  double displacement = 0;  // of the wall [m]
};

}  // namespace stillpoint

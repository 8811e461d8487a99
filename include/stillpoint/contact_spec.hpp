// The specification of contact between two bodies, as a scene gives it.
#pragma once

#include <stillpoint/shear_limit.hpp>

#include <string>
#include <vector>

namespace stillpoint {

struct ContactSpec {                // [[contact]]: two bodies that push each other where they meet, and never hold back
  std::vector<std::string> bodies;  // their names; the border of the first is where contact is looked for
  ShearLimit shear;                 // what it bears along the border

  /// Its name in history.csv and summary.json, "block+base".
  std::string name() const { return bodies.size() == 2 ? bodies[0] + "+" + bodies[1] : std::string(); }
};

}  // namespace stillpoint

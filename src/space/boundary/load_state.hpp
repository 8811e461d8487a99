// What a load control (load_control.hpp) has come to.
#pragma once

namespace stillpoint {

struct LoadState {
  double factor = 0;        // λ of the reference loads
  double displacement = 0;  // q, their mean displacement [m]
};

}  // namespace stillpoint

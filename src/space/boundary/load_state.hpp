// The state of a load control (load_control.hpp).
#pragma once

namespace stillpoint {

struct LoadState {
  double factor = 0;        // λ of the reference loads
  double displacement = 0;  // q, their mean displacement [m]
  double prescribed = 0;    // the prescribed q(t) [m]
};

}  // namespace stillpoint

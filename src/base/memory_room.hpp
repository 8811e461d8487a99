// How much more memory this process may take.
#pragma once

#include <string>

namespace stillpoint {

struct MemoryRoom {
  double bytes = 0;    // infinite if nothing is known
  std::string set_by;  // "MemAvailable of /proc/meminfo", "memory.max of the control group", "RLIMIT_AS", …
};

/// The least of what the machine has left, the control group and the limits on the process allow.
MemoryRoom memory_room();

}  // namespace stillpoint

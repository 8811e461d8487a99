// The memory that this process may still take.
#pragma once

#include <string>

namespace stillpoint {

struct MemoryRoom {
  double bytes = 0;    // infinite if nothing is known
  std::string set_by;  // "MemAvailable of /proc/meminfo", "memory.max of the control group", "RLIMIT_AS", …
};

/// The smallest room that the machine's free memory, the control group and the limits on the process leave.
MemoryRoom memory_room();

}  // namespace stillpoint

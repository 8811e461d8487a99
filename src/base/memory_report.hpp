// The memory of arrays, for a report of where the memory goes.
#pragma once

#include <string>

namespace stillpoint {

/// An array that is kept for each material point.
struct PointArray {
  std::string name;
  double bytes_per_point;
};

}  // namespace stillpoint

// What a run takes of memory, from its scene alone, before anything of it is made.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "simulation/body_size.hpp"

namespace stillpoint {

struct MemoryNeed {
  struct Part {
    std::string what;
    double bytes = 0;
    std::string key;  // of the scene, that sets it
  };
  BodySize size;
  double bytes_per_point = 0;
  std::vector<Part> parts;  // that are there at once, when most is
  double total() const;     // beside what the program itself takes
};

/// To 30 %, and nothing that is small. What only comes up on the way, as a factor that UMFPACK makes, is not in it.
MemoryNeed memory_need(const Problem& problem);

/// The same. Throws SceneError at the key that sets the largest part, if the process may not take so much.
MemoryNeed require_memory(const Problem& problem);

}  // namespace stillpoint

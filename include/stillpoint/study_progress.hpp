// The progress of a study of many runs.
#pragma once

#include <string>

namespace stillpoint {

struct StudyProgress {
  int done = 0, total = 0;  // runs
  std::string doing;
  double wall_s = 0;
};

}  // namespace stillpoint

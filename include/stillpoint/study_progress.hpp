// What a study of many runs tells while it works.
#pragma once

#include <string>

namespace stillpoint {

struct StudyProgress {
  int done = 0, total = 0;  // runs
  std::string doing;
  double wall_s = 0;
};

}  // namespace stillpoint

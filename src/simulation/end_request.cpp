#include "simulation/end_request.hpp"

#include <fmt/format.h>

namespace stillpoint {

bool EndRequest::asked() {
  if (status_ != RunStatus::running) return true;
  if (const double seconds = wall_.seconds(); wall_time_ > 0 && seconds >= wall_time_) {
    status_ = RunStatus::time_limit;
    reason_ = fmt::format("{:.3g} s of wall time reached stop.wall_time", seconds);
  } else if (interrupted_ && interrupted_()) {
    status_ = RunStatus::interrupted;
    reason_ = "interrupted by the user";
  }
  return status_ != RunStatus::running;
}

}  // namespace stillpoint

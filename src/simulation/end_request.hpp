// What asks a run to end though it could go on: the user, or stop.wall_time.
#pragma once

#include <stillpoint/summary.hpp>

#include <functional>
#include <string>

#include "base/stopwatch.hpp"

namespace stillpoint {

class EndRequest {
 public:
  /// wall_time [s], 0: no limit; interrupted: whether the user asks, empty: nobody does.
  EndRequest(double wall_time, std::function<bool()> interrupted)
      : wall_time_(wall_time), interrupted_(std::move(interrupted)) {}

  /// Since it was made. Who asked once is not asked again.
  bool asked();
  /// time_limit or interrupted; running: nothing asks.
  RunStatus status() const { return status_; }
  /// The same in words.
  const std::string& reason() const { return reason_; }

 private:
  Stopwatch wall_;
  double wall_time_;
  std::function<bool()> interrupted_;
  RunStatus status_ = RunStatus::running;
  std::string reason_;
};

}  // namespace stillpoint

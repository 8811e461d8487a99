// A request that a run ends though it could go on: by its user, or because stop.wall_time is over.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "simulation/verdict.hpp"

namespace stillpoint {

class EndRequest {
 public:
  /// wall_time: the limit since this object was made [s]; 0: there is none. interrupted: asks the user; may be empty.
  EndRequest(double wall_time, std::function<bool()> interrupted)
      : wall_time_(wall_time), interrupted_(std::move(interrupted)) {}

  /// True if the run is to end. Once this is so the question is not put again.
  bool asked() {
    if (request_.ends()) return true;
    if (const double seconds = wall_.seconds(); wall_time_ > 0 && seconds >= wall_time_) {
      request_ = {RunStatus::time_limit, fmt::format("{:.3g} s of wall time reached stop.wall_time", seconds)};
    } else if (interrupted_ && interrupted_()) {
      request_ = {RunStatus::interrupted, "interrupted by the user"};
    }
    return request_.ends();
  }
  /// time_limit or interrupted; running if nothing has asked for the end.
  RunStatus status() const { return request_.status; }
  const std::string& reason() const { return request_.reason; }
  /// The verdict on a run that heeds the request; `where`: how far it had come.
  Verdict verdict(const std::string& where) const { return {request_.status, request_.reason + "; " + where}; }

 private:
  Stopwatch wall_;
  double wall_time_;
  std::function<bool()> interrupted_;
  Verdict request_;
};

}  // namespace stillpoint

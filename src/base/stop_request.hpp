// How a long computation learns that it is to end before it is done: Ctrl-C, or no time is left. Who starts one says
// whom to ask; the computation asks from time to time, deep down, without being handed anything.
#pragma once

#include <exception>
#include <functional>

namespace stillpoint {

/// What a computation that is to end throws.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped before it was done"; }
};

/// While it lives, heed_stop_request() asks `asked` in this thread, in place of whom it asked before; empty: nobody.
class StopScope {
 public:
  explicit StopScope(std::function<bool()> asked);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  std::function<bool()> asked_;
  const std::function<bool()>* before_;
};

/// Throws Stopped if the computation is to end. Not within a parallel loop, and not where a state is half changed.
void heed_stop_request();
/// Whether there is anybody to ask.
bool may_be_stopped();

}  // namespace stillpoint

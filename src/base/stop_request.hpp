// The means by which a long computation learns that it has to stop early: Ctrl-C, or no time is left. The caller that
// starts it supplies the question; the computation asks it from time to time, deep down, without being passed anything.
#pragma once

#include <exception>
#include <functional>

namespace stillpoint {

/// Thrown by a computation that has to stop early.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped before it was done"; }
};

/// While this exists, heed_stop_request() in this thread calls `asked` in place of the previous function; empty: none.
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

/// Throws Stopped if the computation has to stop. Not to be called in a parallel loop, or while a state is half
/// changed.
void heed_stop_request();
/// Whether a StopScope with a function is active in this thread.
bool may_be_stopped();

}  // namespace stillpoint

// Ctrl-C while C++ works without the GIL: Python only notes the signal then, and the working code has to ask for it.
#pragma once

#include <chrono>
#include <memory>

#include "python/held.hpp"

namespace stillpoint::python {

class Interrupt {
 public:
  /// Whether Python's signal handlers have raised an exception. Checks at intervals, and takes the GIL for that. Once
  /// true it stays true until throw_what_was_raised().
  bool asked() {
    if (raised_) return true;
    const auto now = Clock::now();
    if (now < next_look_) return false;
    next_look_ = now + pause;
    const pybind11::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) raised_ = std::make_unique<pybind11::error_already_set>();
    return raised_ != nullptr;
  }
  /// Like asked(), for work that is usually short: checks only after half a second.
  bool asked_of_what_takes_long() { return raised_ || (Clock::now() >= begun_ + long_time && asked()); }
  void begin() { begun_ = Clock::now(); }
  /// Needs the GIL.
  void throw_what_was_raised() {
    if (!raised_) return;
    const pybind11::error_already_set error = *raised_;
    raised_.reset();
    throw error;  // NOLINT(misc-throw-by-value-catch-by-reference): throws a copy
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pause{20}, long_time{500};

  Clock::time_point next_look_{}, begun_ = Clock::now();
  std::unique_ptr<pybind11::error_already_set> raised_;
};

}  // namespace stillpoint::python

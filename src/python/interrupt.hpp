// Ctrl-C while C++ is at work, which has let go of the GIL: Python only notes the signal then, and somebody has to ask.
#pragma once

#include <chrono>
#include <memory>

#include "python/held.hpp"

namespace stillpoint::python {

class Interrupt {
 public:
  /// Whether Python's handlers of the signals that came have raised. It looks now and then, and takes the GIL for that.
  /// From then on it is true, until what they raised is thrown.
  bool asked() {
    if (raised_) return true;
    const auto now = Clock::now();
    if (now < next_look_) return false;
    next_look_ = now + pause;
    const pybind11::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) raised_ = std::make_unique<pybind11::error_already_set>();
    return raised_ != nullptr;
  }
  /// The same of something that should be over soon: not before it has taken half a second.
  bool asked_of_what_takes_long() { return raised_ || (Clock::now() >= begun_ + long_time && asked()); }
  void begin() { begun_ = Clock::now(); }
  /// With the GIL held.
  void throw_what_was_raised() {
    if (!raised_) return;
    const pybind11::error_already_set error = *raised_;
    raised_.reset();
    throw error;  // NOLINT(misc-throw-by-value-catch-by-reference): a copy is what is thrown
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pause{20}, long_time{500};

  Clock::time_point next_look_{}, begun_ = Clock::now();
  std::unique_ptr<pybind11::error_already_set> raised_;
};

}  // namespace stillpoint::python

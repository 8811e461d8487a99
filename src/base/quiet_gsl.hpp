// A scope in which GSL reports errors by return values.
#pragma once

#include <mutex>

#include <gsl/gsl_errno.h>

namespace stillpoint {

/// While any object of this class exists, in whatever thread, GSL returns its errors instead of aborting the program;
/// after the last one is destroyed the former error handler is back. All share it: restoring a handler that was read
/// earlier could end another's silence.
class QuietGsl {
 public:
  QuietGsl() {
    const std::lock_guard lock(mutex_);
    if (living_++ == 0) former_ = gsl_set_error_handler_off();
  }
  QuietGsl(const QuietGsl&) = delete;
  QuietGsl& operator=(const QuietGsl&) = delete;
  ~QuietGsl() {
    const std::lock_guard lock(mutex_);
    if (--living_ == 0) gsl_set_error_handler(former_);
  }

 private:
  static inline std::mutex mutex_;
  static inline long living_ = 0;
  static inline gsl_error_handler_t* former_ = nullptr;
};

}  // namespace stillpoint

// A scope in which GSL reports errors by return values.
#pragma once

namespace stillpoint {

/// While any object of this class exists, in whatever thread, GSL returns its errors instead of aborting the program;
/// after the last one is destroyed the former error handler is back.
class QuietGsl {
 public:
  QuietGsl();
  QuietGsl(const QuietGsl&) = delete;
  QuietGsl& operator=(const QuietGsl&) = delete;
  ~QuietGsl();
};

}  // namespace stillpoint

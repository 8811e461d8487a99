// GSL's errors as return values.
#pragma once

namespace stillpoint {

/// While any of these lives, in whatever thread, GSL returns its errors in place of aborting the program; after the
/// last one it does again what it did before the first.
class QuietGsl {
 public:
  QuietGsl();
  QuietGsl(const QuietGsl&) = delete;
  QuietGsl& operator=(const QuietGsl&) = delete;
  ~QuietGsl();
};

}  // namespace stillpoint

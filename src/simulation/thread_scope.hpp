// The number of OpenMP's threads while one part of a program works.
#pragma once

#include <omp.h>

namespace stillpoint {

/// While it lives, loops take `threads` threads; afterwards as many as before.
class ThreadScope {
 public:
  /// 0: as many as OpenMP would take.
  explicit ThreadScope(int threads) : before_(omp_get_max_threads()) {
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadScope() { omp_set_num_threads(before_); }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  int before_;
};

}  // namespace stillpoint

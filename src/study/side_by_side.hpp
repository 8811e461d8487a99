// Runs that are independent of each other, side by side.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

#include "base/thread_team.hpp"

namespace stillpoint {

/// Calls run(k) for k = 0 … n − 1, each on a single one of the threads, so that results do not depend on their number.
/// Throws the first exception, in the order of k, once all are done.
template <class Run>
void side_by_side(int threads, std::size_t n, const Run& run) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> thrown(n);
  const auto work = [&] {
    const ThreadScope alone(1);
    for (std::size_t k = next++; k < n; k = next++) {
      try {
        run(k);
      } catch (...) {
        thrown[k] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < std::min(threads, static_cast<int>(n)); ++k) others.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& error : thrown)
    if (error) std::rethrow_exception(error);
}

}  // namespace stillpoint

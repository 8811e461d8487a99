// The threads that share the work of a loop. They stand by between loops, so that it costs less than a microsecond to
// begin and to end one, and who has nothing left to do takes over what another has not begun: a thread that the system
// does not let run is not waited for.
//
// OpenMP's own loops cost more: GCC's call the system at each barrier, even in a team of one thread.
#pragma once

#include <algorithm>
#include <cstddef>

#include <omp.h>

namespace stillpoint {

/// The number of threads that loops of the calling thread take: OpenMP's, so that OMP_NUM_THREADS holds for them and
/// for BLAS. It is 1 inside a part of a loop.
inline int loop_threads() { return omp_get_max_threads(); }

/// While it lives, loops of the calling thread take `threads` threads; afterwards as many as before.
class ThreadScope {
 public:
  /// 0: as many as before.
  explicit ThreadScope(int threads) : before_(omp_get_max_threads()) {
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadScope() { omp_set_num_threads(before_); }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  int before_;
};

/// Calls work(of, part) for part = 0 … parts − 1 ≤ 65 534, in any order, by this thread and threads − 1 others, and
/// returns when all are done. Throws what a part has thrown, one if there are several.
void share_parts(int threads, std::size_t parts, void (*work)(const void* of, std::size_t part), const void* of);

/// Calls body(begin, end) for ranges that make up 0 … n − 1, parts_a_thread for each thread of the calling thread's
/// loops: few if the parts take equal times, more if they do not.
template <class Body>
inline void in_parts(std::size_t n, std::size_t parts_a_thread, const Body& body) {
  const int threads = loop_threads();
  if (threads == 1) {
    body(std::size_t{0}, n);
    return;
  }
  struct Loop {
    const Body& body;
    std::size_t n, parts;
  };
  const Loop loop{body, n, std::min(n, parts_a_thread * static_cast<std::size_t>(threads))};
  const auto work = [](const void* of, std::size_t part) {
    const auto& [one_body, count, parts] = *static_cast<const Loop*>(of);
    one_body(part * count / parts, (part + 1) * count / parts);
  };
  share_parts(threads, loop.parts, work, &loop);
}

/// The same for ranges that begin at multiples of `grain`: the same ranges for each thread in any loop over as many
/// entries, whatever parts_a_thread, so that what a core has in its caches is what it works on next.
template <class Body>
inline void in_aligned_parts(std::size_t n, std::size_t parts_a_thread, const Body& body) {
  constexpr std::size_t grain = 1024;
  const std::size_t grains = (n + grain - 1) / grain, threads = static_cast<std::size_t>(loop_threads());
  if (threads == 1) {
    body(std::size_t{0}, n);
    return;
  }
  const std::size_t parts = parts_a_thread * threads;
  const auto begin_of = [=](std::size_t part) { return std::min(n, part * grains / parts * grain); };
  in_parts(parts, parts_a_thread, [&](std::size_t first, std::size_t last) {
    if (const std::size_t begin = begin_of(first), end = begin_of(last); begin < end) body(begin, end);
  });
}

}  // namespace stillpoint

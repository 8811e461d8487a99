#include "base/thread_team.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <sched.h>

namespace stillpoint {
namespace {

// How long a thread that has nothing to do looks for work before it sleeps: longer than what most steps do between
// loops, much shorter than the time for which a system lets a program run.
constexpr std::chrono::microseconds looks_for{50};

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Returns once value is no longer `old`.
template <class T>
void wait_while(const std::atomic<T>& value, T old) {
  constexpr int looks = 32;  // between two looks at the clock
  const auto begin = std::chrono::steady_clock::now();
  do {
    for (int k = 0; k < looks; ++k) {
      if (value.load(std::memory_order_acquire) != old) return;
      pause();
    }
  } while (std::chrono::steady_clock::now() - begin < looks_for);
  value.wait(old, std::memory_order_acquire);
}

// What a team and its threads share. A loop has a number; a range of its parts holds the number too, so that a thread
// that comes late, when the next loop is being written, finds nothing that it could take for its own.
class Board {
 public:
  using Work = void (*)(const void* of, std::size_t part);

  explicit Board(std::size_t threads) : ranges_(threads) {}
  std::size_t most_threads() const { return ranges_.size(); }

  void run(std::size_t threads, std::size_t parts, Work work, const void* of) {
    // Nobody works on the loop of before, so that nobody who reads this can take a part.
    work_.store(work, std::memory_order_relaxed);
    of_.store(of, std::memory_order_relaxed);
    threads_.store(threads, std::memory_order_relaxed);
    unfinished_.store(static_cast<std::uint32_t>(parts), std::memory_order_relaxed);
    const std::uint32_t number = loop_.load(std::memory_order_relaxed) + 1;
    for (std::size_t k = 0; k < threads; ++k) {
      ranges_[k].left.store(range(number, k * parts / threads, (k + 1) * parts / threads), std::memory_order_release);
    }
    loop_.store(number);
    loop_.notify_all();
    take_parts(number, 0);
    while (const std::uint32_t unfinished = unfinished_.load(std::memory_order_acquire))
      wait_while(unfinished_, unfinished);
    if (has_failed_.load(std::memory_order_relaxed)) {
      has_failed_ = false;
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }

  // Takes part in loops, as one of the others, until close() is called.
  void stand_by(std::size_t self) {
    for (std::uint32_t seen = 0; !closed_.load(std::memory_order_relaxed);) {
      wait_while(loop_, seen);
      seen = loop_.load(std::memory_order_acquire);
      take_parts(seen, self);
    }
  }
  void close() {
    closed_ = true;
    ++loop_;
    loop_.notify_all();
  }

 private:
  // The parts that nobody has begun: the loop's number, the first of them and one past the last.
  struct alignas(64) Range {
    std::atomic<std::uint64_t> left{0};
  };
  static std::uint64_t range(std::uint32_t number, std::size_t begin, std::size_t end) {
    return static_cast<std::uint64_t>(number) << 32 | static_cast<std::uint64_t>(begin) << 16 | end;
  }

  // Takes the first part of a range, if it is one of this loop and there is one.
  static bool takes(Range& from, std::uint32_t number, std::size_t& part) {
    std::uint64_t left = from.left.load(std::memory_order_acquire);
    for (;;) {
      const std::size_t begin = left >> 16 & 0xffff, end = left & 0xffff;
      if (left >> 32 != number || begin == end) return false;
      if (from.left.compare_exchange_weak(left, range(number, begin + 1, end), std::memory_order_acq_rel)) {
        part = begin;
        return true;
      }
    }
  }
  // Does one's own parts, then those that others have not begun.
  void take_parts(std::uint32_t number, std::size_t self) {
    const Work work = work_.load(std::memory_order_relaxed);
    const void* const of = of_.load(std::memory_order_relaxed);
    const std::size_t threads = threads_.load(std::memory_order_relaxed);
    if (self >= threads) return;
    std::uint32_t done = 0;
    for (std::size_t k = 0; k < threads; ++k) {
      Range& from = ranges_[(self + k) % threads];
      for (std::size_t part = 0; takes(from, number, part); ++done) {
        try {
          work(of, part);
        } catch (...) {
          const std::scoped_lock lock(failing_);
          failure_ = std::current_exception();
          has_failed_ = true;
        }
      }
    }
    if (done > 0 && unfinished_.fetch_sub(done, std::memory_order_acq_rel) == done) unfinished_.notify_one();
  }

  alignas(64) std::atomic<std::uint32_t> loop_{0};
  std::atomic<Work> work_{nullptr};
  std::atomic<const void*> of_{nullptr};
  std::atomic<std::size_t> threads_{0};
  std::atomic<bool> closed_{false}, has_failed_{false};
  alignas(64) std::atomic<std::uint32_t> unfinished_{0};
  std::vector<Range> ranges_;
  std::mutex failing_;
  std::exception_ptr failure_;
};

// Where OMP_PROC_BIND asks that threads stay on a core, OpenMP has bound the first of them, and a thread of ours begins
// on the same core: it goes to the next place of OpenMP's list.
void go_to_own_place(std::size_t self) {
  const int places = omp_get_num_places();
  if (omp_get_proc_bind() == omp_proc_bind_false || places == 0) return;
  const int place = static_cast<int>(self) % places;
  std::vector<int> processors(static_cast<std::size_t>(omp_get_place_num_procs(place)));
  omp_get_place_proc_ids(place, processors.data());
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors) CPU_SET(static_cast<std::size_t>(processor), &set);
  sched_setaffinity(0, sizeof(set), &set);  // if it is refused the thread stays where it is
}

// The other threads of a thread's loops. They are not joined: after a fork of the process they are not there, and
// loops go on without them.
class Team {
 public:
  Team() = default;
  ~Team() { close(); }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  Board& of(std::size_t threads) {
    if (board_ && board_->most_threads() >= threads) return *board_;
    close();
    board_ = std::make_shared<Board>(threads);
    for (std::size_t self = 1; self < threads; ++self) {
      std::thread([board = board_, self] {
        omp_set_num_threads(1);
        go_to_own_place(self);
        board->stand_by(self);
      }).detach();
    }
    return *board_;
  }

 private:
  void close() {
    if (board_) board_->close();
  }

  std::shared_ptr<Board> board_;
};

}  // namespace

void share_parts(int threads, std::size_t parts, void (*work)(const void* of, std::size_t part), const void* of) {
  static thread_local Team team;
  Board& board = team.of(static_cast<std::size_t>(threads));
  const ThreadScope alone_in_parts(1);
  board.run(static_cast<std::size_t>(threads), parts, work, of);
}

}  // namespace stillpoint

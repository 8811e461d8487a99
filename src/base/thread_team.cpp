#include "base/thread_team.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
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

using Clock = std::chrono::steady_clock;

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

// Looks until something is so, or for a time. Returns whether it is.
template <class IsSo>
bool look(Clock::duration time, const IsSo& is_so) {
  constexpr int looks = 32;  // between two looks at the clock
  const auto begin = Clock::now();
  do {
    for (int k = 0; k < looks; ++k) {
      if (is_so()) return true;
      pause();
    }
  } while (Clock::now() - begin < time);
  return false;
}

using Work = void (*)(const void* of, std::size_t part);

// A loop: each thread has `each` of its parts, the last ones fewer.
struct Loop {
  Work work = nullptr;
  const void* of = nullptr;
  std::size_t threads = 0, parts = 0, each = 0;
  std::uint64_t begin = 0;  // the ticket of each thread's first part
};

// What a team and its threads share. A line of memory takes a third of a microsecond from one core to another that is
// far, which is what a loop costs at least: so each of them writes to few, and only to its own. The tickets of a
// thread's parts go on from loop to loop, so that a thread that comes late finds its tickets taken.
class Board {
 public:
  explicit Board(std::size_t threads) : shares_(threads) {}
  std::size_t most_threads() const { return shares_.size(); }

  // By the thread whose team it is.
  void run(std::size_t threads, std::size_t parts, Work work, const void* of) {
    const Loop loop{work, of, threads, parts, (parts + threads - 1) / threads, tickets_};
    tickets_ += loop.each;
    for (std::size_t k = 0; k < threads; ++k) {  // who had no part in the last loop has tickets of another
      if (shares_[k].next.load(std::memory_order_relaxed) != loop.begin)
        shares_[k].next.store(loop.begin, std::memory_order_relaxed);
    }
    std::uint64_t of_all = 0;
    for (const Share& share : shares_) of_all += share.done.load(std::memory_order_relaxed);
    of_all += loop.each * threads;
    publish(loop);
    take_parts(loop, 0);
    const auto is_done = [&] {
      std::uint64_t done = 0;
      for (const Share& share : shares_) done += share.done.load(std::memory_order_acquire);
      return done == of_all;
    };
    while (!look(looks_for, is_done)) std::this_thread::sleep_for(looks_for);
    if (has_failed_.load(std::memory_order_relaxed)) {
      has_failed_ = false;
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }

  // Takes part in loops, as one of the others, until close() is called.
  void stand_by(std::size_t self) {
    std::uint32_t seen = 0;
    const auto is_new = [&] { return number_.load(std::memory_order_acquire) != seen; };
    for (;;) {
      if (!look(looks_for, is_new)) number_.wait(seen, std::memory_order_acquire);
      if (closed_.load(std::memory_order_relaxed)) return;
      const std::uint32_t number = number_.load(std::memory_order_acquire);
      if (number % 2 != 0) continue;  // it is being written
      const Loop loop{work_.load(std::memory_order_relaxed),    of_.load(std::memory_order_relaxed),
                      threads_.load(std::memory_order_relaxed), parts_.load(std::memory_order_relaxed),
                      each_.load(std::memory_order_relaxed),    begin_.load(std::memory_order_relaxed)};
      std::atomic_thread_fence(std::memory_order_acquire);
      if (number_.load(std::memory_order_relaxed) != number) continue;  // it has been written meanwhile
      seen = number;
      if (self < loop.threads) take_parts(loop, self);
    }
  }
  void close() {
    closed_ = true;
    number_ += 2;
    number_.notify_all();
  }

 private:
  struct alignas(128) Share {
    std::atomic<std::uint64_t> next{0};  // the next ticket of the thread's own parts
    std::atomic<std::uint64_t> done{0};  // how many tickets, anyone's, this thread has done
  };

  void publish(const Loop& loop) {
    const std::uint32_t number = number_.load(std::memory_order_relaxed);
    number_.store(number + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    work_.store(loop.work, std::memory_order_relaxed);
    of_.store(loop.of, std::memory_order_relaxed);
    threads_.store(loop.threads, std::memory_order_relaxed);
    parts_.store(loop.parts, std::memory_order_relaxed);
    each_.store(loop.each, std::memory_order_relaxed);
    begin_.store(loop.begin, std::memory_order_relaxed);
    number_.store(number + 2);
    number_.notify_all();
  }

  // Does one's own parts, then those that others have not begun although it is high time: what a part works on is in
  // the caches of the core that did it last.
  void take_parts(const Loop& loop, std::size_t self) {
    constexpr Clock::duration least_patience = std::chrono::microseconds(10);
    const auto begin = Clock::now();
    take_parts_of(loop, self, self);
    const auto all_are_taken = [&] {
      for (std::size_t k = 0; k < loop.threads; ++k)
        if (shares_[k].next.load(std::memory_order_relaxed) < loop.begin + loop.each) return false;
      return true;
    };
    if (look(std::max(least_patience, (Clock::now() - begin) / 2), all_are_taken)) return;
    for (std::size_t k = 1; k < loop.threads; ++k) take_parts_of(loop, (self + k) % loop.threads, self);
  }
  void take_parts_of(const Loop& loop, std::size_t owner, std::size_t self) {
    const std::uint64_t end = loop.begin + loop.each;
    std::atomic<std::uint64_t>& next = shares_[owner].next;
    std::uint64_t done = 0;
    for (std::uint64_t ticket = next.load(std::memory_order_relaxed); ticket < end;) {
      if (!next.compare_exchange_weak(ticket, ticket + 1, std::memory_order_acq_rel)) continue;
      const std::size_t part = owner * loop.each + (ticket - loop.begin);
      try {
        if (part < loop.parts) loop.work(loop.of, part);
      } catch (...) {
        const std::scoped_lock lock(failing_);
        failure_ = std::current_exception();
        has_failed_ = true;
      }
      ++done;
      ++ticket;
    }
    if (done == 0) return;
    std::atomic<std::uint64_t>& all_done = shares_[self].done;
    all_done.store(all_done.load(std::memory_order_relaxed) + done, std::memory_order_release);
  }

  // The present loop, and its number; odd: it is being written.
  alignas(128) std::atomic<std::uint32_t> number_{0};
  std::atomic<bool> closed_{false}, has_failed_{false};
  std::atomic<Work> work_{nullptr};
  std::atomic<const void*> of_{nullptr};
  std::atomic<std::size_t> threads_{0}, parts_{0}, each_{0};
  std::atomic<std::uint64_t> begin_{0};
  std::vector<Share> shares_;
  std::uint64_t tickets_ = 0;  // of each thread, of all loops so far
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

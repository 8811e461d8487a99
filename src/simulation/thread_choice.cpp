#include "simulation/thread_choice.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"
#include "base/stopwatch.hpp"
#include "base/thread_team.hpp"

namespace stillpoint {
namespace {

// The time of a loop over a vector that stays in the cache. It is repeated for longer than a program is let run at
// once.
double seconds_of_loops(std::vector<double>& x, int threads, double at_least) {
  const ThreadScope scope(threads);
  const Stopwatch watch;
  int loops = 0;
  do {
    for_each_index(x.size(), [to = x.data()](std::size_t i) { to[i] = 0.5 * to[i] + 1; });
    ++loops;
  } while (watch.seconds() < at_least);
  return watch.seconds() / loops;
}

}  // namespace

int ThreadChoice::threads() const {
  if (!chooses_ || trial_ == turns) return best_;
  return trial_ % 2 == 0 ? 1 : all_;
}

void ThreadChoice::observe(double seconds) {
  if (!chooses_) return;
  ++steps_[threads() == all_];
  if (trial_ < turns) {
    Timing& timing = timings_[static_cast<std::size_t>(trial_ % 2)];
    timing.seconds += seconds;
    ++timing.steps;
    in_trial_ += seconds;
    if (in_trial_ < trial_s) return;
    in_trial_ = 0;
    ++trial_;
    // If a first look says enough, no time is lost with a second.
    const bool hopeless = trial_ == 2 && timings_[1].mean() > 2 * timings_[0].mean();
    if (trial_ == turns || hopeless) end_trial();
    return;
  }
  until_trial_ -= seconds;
  since_.seconds += seconds;
  ++since_.steps;
  if (since_.seconds >= watch_s) {
    if (best_ == all_ && since_.mean() > of_one_) {  // it was a gain, and is none any more
      best_ = 1;
      until_trial_ = interval_ = shortest_s;
    }
    since_ = {};
  }
  if (until_trial_ > 0) return;
  trial_ = 0;
  timings_ = {};
}

void ThreadChoice::end_trial() {
  trial_ = turns;
  of_one_ = timings_[0].mean();
  const double largest_share = is_asked_ ? 1 : least_gain;
  const int before = std::exchange(best_, timings_[1].mean() < largest_share * of_one_ ? all_ : 1);
  interval_ = best_ == before ? std::min(2 * interval_, longest_s) : shortest_s;
  until_trial_ = interval_;
  since_ = {};
}

int threads_to_begin_with(int asked, double points) {
  constexpr double large_body = 5000;  // whose set-up takes longer than this trial
  const int all = asked > 0 ? asked : loop_threads();
  if (all == 1 || points < large_body) return all;
  constexpr double at_least = 0.006;  // [s]
  std::vector<double> x(1 << 16);
  seconds_of_loops(x, all, 0);  // starts the threads
  const double one = seconds_of_loops(x, 1, at_least), of_all = seconds_of_loops(x, all, at_least);
  return of_all < one ? all : 1;
}

}  // namespace stillpoint

// The number of threads of a run: one, or all that it may have, whichever is quicker. Results do not depend on it.
#pragma once

#include <array>
#include <limits>

namespace stillpoint {

/// Tries both at the start and now and then, a few milliseconds each: a second thread is no gain in a small scene, and
/// a loss where another program keeps a core busy, since a loop waits for a thread that is stopped amid its work.
class ThreadChoice {
 public:
  static constexpr double trial_s = 0.005;     // length of a trial of one number, made twice
  static constexpr double watch_s = 0.025;     // time after which all threads are compared with one
  static constexpr double shortest_s = 0.5;    // from trial to trial; twice as long after each that changes nothing,
  static constexpr double longest_s = 8;       // up to this
  static constexpr double least_gain = 0.95;   // largest share of the time of one thread that all threads may take
  static constexpr double first_look_s = 0.1;  // time after which a number that was asked for is tried against one

  /// asked: the largest number, which is taken unless one thread is quicker; 0: one or all, if that is a gain.
  /// may_choose: whether the times of steps can be compared; otherwise it is the largest number.
  ThreadChoice(int asked, int all, bool may_choose = true)
      : all_(asked > 0 ? asked : all), chooses_(may_choose && all_ > 1), is_asked_(asked > 0) {
    if (!chooses_ || is_asked_) best_ = all_;
    if (!is_asked_) return;
    trial_ = turns;
    until_trial_ = first_look_s;
    of_one_ = std::numeric_limits<double>::infinity();  // not known
  }

  /// The number for the next step.
  int threads() const;
  /// The number that most steps were taken with.
  int usual() const {
    if (!chooses_ || (is_asked_ && steps_[1] == steps_[0])) return all_;
    return steps_[1] > steps_[0] ? all_ : 1;
  }
  /// Takes the time of each step [s].
  void observe(double seconds);

 private:
  struct Timing {
    double seconds = 0;
    long steps = 0;
    double mean() const { return seconds / static_cast<double>(steps); }
  };
  void end_trial();

  static constexpr int turns = 4;

  int all_;
  bool chooses_, is_asked_;
  int best_ = 1;
  int trial_ = 0;                                   // 0 … 3: one, all, one, all; turns: no trial
  double in_trial_ = 0;                             // [s]
  std::array<Timing, 2> timings_;                   // in the trial with one thread, and with all
  Timing since_;                                    // since the last look
  double of_one_ = 0;                               // seconds a step of one thread, at the last trial
  double until_trial_ = 0, interval_ = shortest_s;  // [s]
  std::array<long, 2> steps_{};                     // taken with one thread, and with all
};

/// The number for the set-up of a body of so many points: all threads, or one if they are busy elsewhere, which loops
/// of a few milliseconds tell; these loops pay for large bodies alone. asked: the largest number; 0: all that there
/// are.
int threads_to_begin_with(int asked, double points);

}  // namespace stillpoint

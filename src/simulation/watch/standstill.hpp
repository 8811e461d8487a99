// A run that stands still: a body that is drawn out or crushed without end stiffens without end, its stable step goes
// to nothing, and all the steps that are left would take it nowhere.
#pragma once

#include <fmt/format.h>

#include "simulation/watcher.hpp"

namespace stillpoint {

class Standstill : public Watcher {
 public:
  static constexpr int patience = 30'000;           // [steps]: a body that is crushed turns inside out before
  static constexpr double negligible_share = 1e-6;  // share of a full step that a body stiffened by 1e12 can take

  /// full_step: the longest that a step may be at the start [s].
  explicit Standstill(double full_step) : full_step_(full_step) {}

  void observe(RunState& run) override { take(run.step, run.is_cut); }
  /// A step [s]; is_cut: it is as short as it is to end at a time that was asked for.
  void take(double h, bool is_cut) {
    short_steps_ = !is_cut && h < negligible_share * full_step_ ? short_steps_ + 1 : 0;
  }
  /// True if so many steps in a row have been short that the run will not be over.
  bool lasts() const { return short_steps_ >= patience; }

  Verdict judge(RunState& run) override {
    if (!lasts()) return {};
    return run.failed(fmt::format(
        "time stands still: each of the last {} steps was shorter than {:.0e} of a step at the start, which is {:.3g} "
        "s; {}; {}; expected smaller loads or cells, or a law that does not stiffen without end",
        patience, negligible_share, full_step_, most_stressed(*run.model.phase, run.t, run.motion->u()),
        furthest_from_rest(*run.motion, run.t)));
  }
  void archive(const StateArchive& state, RunState&) override { state("short_steps", short_steps_); }

 private:
  double full_step_;
  int short_steps_ = 0;
};

}  // namespace stillpoint

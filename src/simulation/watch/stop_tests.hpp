// The stopping tests that a scene or a program asks for: equilibrium, the limits of [stop], and options.stop_test.
#pragma once

#include "simulation/watch/creep.hpp"
#include "simulation/watch/monitor.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {

class StopTests : public Watcher {
 public:
  /// creep outlives this object, and learns from it the period that shows on the way.
  StopTests(const RunState& run, Creep& creep);

  Verdict judge(RunState& run) override;
  void archive(const StateArchive& state, RunState&) override { monitor_.archive(state); }

 private:
  Verdict test_equilibrium(RunState& run);
  void follow_period(const RunState& run);

  Creep& creep_;
  Monitor monitor_;
};

}  // namespace stillpoint

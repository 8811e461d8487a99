// The search for a mechanism in a body so large that nobody has looked at its K before the run: it is made once, if the
// run has gone on for long.
#pragma once

#include "simulation/advice/mechanism.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {

class MechanismWatch : public Watcher {
 public:
  explicit MechanismWatch(const RunState& run)
      : looks_(run.scene.stop.wants_equilibrium() && !run.model.omega_1 && run.model.factor_fits) {}

  Verdict judge(RunState& run) override {
    constexpr long patience = 1000;  // [evaluations]
    if (!looks_ || !run.loads_settled() || run.evaluations() < patience) return {};
    // If K is constant any u will do, and the present one has been carried off.
    const LagrangianPhase& phase = *run.model.phase;
    const auto found = find_mechanism(phase, run.t, phase.info().nonlinear ? run.motion->u() : ConstVec(run.model.u));
    looks_ = false;
    return found ? run.failed(to_string(*found)) : Verdict{};
  }
  void archive(const StateArchive& state, RunState&) override { state("looks", looks_); }

 private:
  bool looks_;
};

}  // namespace stillpoint

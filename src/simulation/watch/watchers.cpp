// The list of all watchers. Its order decides which of two that end a run at the same step is heard, and in which order
// notes stand in a summary.
#include <utility>

#include "simulation/advice/mechanism.hpp"
#include "simulation/watch/chatter.hpp"
#include "simulation/watch/creep.hpp"
#include "simulation/watch/equilibrium_stability.hpp"
#include "simulation/watch/limit_load.hpp"
#include "simulation/watch/monitor.hpp"
#include "simulation/watch/standstill.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

/// The search for a mechanism in a body so large that nobody has looked at its K before the run: it is made once, if
/// the run has gone on for long.
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

}  // namespace

std::vector<Watched> make_watchers(RunState& run) {
  std::vector<Watched> list;
  auto creep = std::make_unique<Creep>(run);
  list.push_back({"stability", std::make_unique<StabilityTest>()});
  list.push_back({"single_phase", watch_single_phase()});
  list.push_back({"plastic_path", watch_plastic_path(run)});
  list.push_back({"rate_share", watch_rate_share(run)});
  list.push_back({"multipliers", watch_multipliers(run)});
  list.push_back({"monitor", std::make_unique<Monitor>(run, *creep)});
  list.push_back({"mechanism", std::make_unique<MechanismWatch>(run)});
  list.push_back({"unheld_bodies", watch_unheld_bodies()});
  list.push_back({"standstill", std::make_unique<Standstill>(run.model.integrator.max_step)});
  list.push_back({"creep", std::move(creep)});
  list.push_back({"limit_load", std::make_unique<LimitLoad>(run.scene.stop.load_growth)});
  list.push_back({"chatter", std::make_unique<Chatter>()});
  list.push_back({"passed_bodies", watch_passed_bodies()});
  list.push_back({"sudden_bodies", watch_sudden_bodies(run)});
  list.push_back({"hooked_corners", watch_hooked_corners()});
  list.push_back({"coarse_contact", watch_coarse_contact()});
  list.push_back({"left_in_points", watch_left_in_points()});
  return list;
}

}  // namespace stillpoint

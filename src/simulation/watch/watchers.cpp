// The list of all watchers. Its order decides which of two that end a run at the same step is heard, and in which order
// notes stand in a summary.
#include <memory>
#include <utility>

#include "simulation/watch/chatter.hpp"
#include "simulation/watch/creep.hpp"
#include "simulation/watch/equilibrium_stability.hpp"
#include "simulation/watch/left_in_points.hpp"
#include "simulation/watch/limit_load.hpp"
#include "simulation/watch/mechanism_watch.hpp"
#include "simulation/watch/plastic_path.hpp"
#include "simulation/watch/rate_share.hpp"
#include "simulation/watch/single_phase.hpp"
#include "simulation/watch/standstill.hpp"
#include "simulation/watch/stop_tests.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {

std::vector<Watched> make_watchers(RunState& run) {
  std::vector<Watched> list;
  const auto add = [&list](const char* name, std::unique_ptr<Watcher> watcher) {
    list.push_back({name, std::move(watcher)});
  };
  auto creep = std::make_unique<Creep>(run);
  add("stability", std::make_unique<StabilityTest>());
  add("single_phase", std::make_unique<SinglePhase>());
  add("plastic_path", std::make_unique<PlasticPath>(run.scene, run.model));
  add("rate_share", std::make_unique<RateShare>(run.scene, *run.model.phase));
  add("monitor", std::make_unique<StopTests>(run, *creep));
  add("mechanism", std::make_unique<MechanismWatch>(run));
  add("standstill", std::make_unique<Standstill>(run.model.integrator.max_step));
  add("creep", std::move(creep));
  add("limit_load", std::make_unique<LimitLoad>(run.scene.stop.load_growth));
  add("chatter", std::make_unique<Chatter>());
  add("left_in_points", std::make_unique<LeftInPoints>());
  return list;
}

}  // namespace stillpoint

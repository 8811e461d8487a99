// The list of all watchers. Its order decides which of two that end a run at the same step is heard, and in which order
// notes stand in a summary.
#include <utility>

#include "simulation/watch/chatter.hpp"
#include "simulation/watch/creep.hpp"
#include "simulation/watch/equilibrium_stability.hpp"
#include "simulation/watch/left_in_points.hpp"
#include "simulation/watch/limit_load.hpp"
#include "simulation/watch/mechanism_watch.hpp"
#include "simulation/watch/monitor.hpp"
#include "simulation/watch/plastic_path.hpp"
#include "simulation/watch/rate_share.hpp"
#include "simulation/watch/single_phase.hpp"
#include "simulation/watch/standstill.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {

std::vector<Watched> make_watchers(RunState& run) {
  std::vector<Watched> list;
  auto creep = std::make_unique<Creep>(run);
  list.push_back({"stability", std::make_unique<StabilityTest>()});
  list.push_back({"single_phase", std::make_unique<SinglePhase>()});
  list.push_back({"plastic_path", std::make_unique<PlasticPath>(run)});
  list.push_back({"rate_share", std::make_unique<RateShare>(run)});
  list.push_back({"monitor", std::make_unique<Monitor>(run, *creep)});
  list.push_back({"mechanism", std::make_unique<MechanismWatch>(run)});
  list.push_back({"standstill", std::make_unique<Standstill>(run.model.integrator.max_step)});
  list.push_back({"creep", std::move(creep)});
  list.push_back({"limit_load", std::make_unique<LimitLoad>(run.scene.stop.load_growth)});
  list.push_back({"chatter", std::make_unique<Chatter>()});
  list.push_back({"left_in_points", std::make_unique<LeftInPoints>()});
  return list;
}

}  // namespace stillpoint

#include <stillpoint/run.hpp>

#include "base/atomic_file.hpp"
#include "simulation/stopped_set_up.hpp"

namespace stillpoint {
namespace {

Summary simulate(const Scene& scene, const SimulationOptions& options) {
  try {
    Simulation simulation(scene, options);
    simulation.run();
    return simulation.summary();
  } catch (const SetUpStopped& stopped) {
    return leave_stopped_set_up(scene, options, stopped);
  }
}

}  // namespace

Summary run(const Scene& scene, const SimulationOptions& options) {
  Summary summary = simulate(scene, options);
  if (!options.out.empty()) write_file(options.out / "summary.json", to_json(summary));
  return summary;
}

}  // namespace stillpoint

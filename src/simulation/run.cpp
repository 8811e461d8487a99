#include <stillpoint/run.hpp>

#include "base/atomic_file.hpp"

namespace stillpoint {

Summary run(const Scene& scene, const SimulationOptions& options) {
  Simulation simulation(scene, options);
  simulation.run();
  Summary summary = simulation.summary();
  if (!options.out.empty()) {
    AtomicFile file(options.out / "summary.json");
    file.write(to_json(summary));
    file.finish();
  }
  return summary;
}

}  // namespace stillpoint

#include <stillpoint/run.hpp>

#include <stdexcept>
#include <string>

#include "base/atomic_file.hpp"
#include "output/report/report_page.hpp"
#include "output/report/run_report.hpp"
#include "simulation/stopped_set_up.hpp"

namespace stillpoint {
namespace {

BodyMoment now(const Simulation& simulation) {
  return moment_of(simulation.phase(), simulation.t(), simulation.u(), simulation.v());
}

// Between two phases of which the second could not begin there is no body to look at.
bool is_readable(Simulation& simulation) {
  try {
    simulation.field("u");
    return true;
  } catch (const std::logic_error&) {
    return false;
  }
}

Summary simulate(const Scene& scene, const SimulationOptions& options, RunReport& report) {
  try {
    Simulation simulation(scene, options);
    if (report.looks_at_body()) report.begin(now(simulation));
    simulation.run();
    if (report.looks_at_body() && is_readable(simulation)) report.end(now(simulation));
    return simulation.summary();
  } catch (const SetUpStopped& stopped) {
    return leave_stopped_set_up(scene, options, stopped);
  }
}

}  // namespace

Summary run(const Scene& scene, const SimulationOptions& options) {
  RunReport report(scene, options.out);
  Summary summary = simulate(scene, options, report);
  if (options.out.empty()) return summary;
  const std::string json = to_json(summary), page = report.page(summary);  // before either is written
  write_file(options.out / "summary.json", json);
  write_file(options.out / report_name, page);
  return summary;
}

}  // namespace stillpoint

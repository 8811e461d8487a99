#include <stillpoint/run.hpp>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "base/atomic_file.hpp"
#include "output/folder_lock.hpp"
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

// lock: of the folder, from when the run begins.
Summary simulate(const Scene& scene, const SimulationOptions& options, RunReport& report,
                 std::shared_ptr<FolderLock>& lock) {
  try {
    Simulation simulation(scene, options);
    if (!options.out.empty()) lock = lock_folder(options.out);
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
  std::shared_ptr<FolderLock> lock;
  if (std::filesystem::is_directory(options.out))
    lock = lock_folder(options.out);  // before a set-up, which may be long
  RunReport report(scene, options.out);
  Summary summary = simulate(scene, options, report, lock);
  if (options.out.empty()) return summary;
  const std::string json = to_json(summary), page = report.page(summary);  // before either is written
  write_file(options.out / "summary.json", json);
  write_file(options.out / report_name, page);
  return summary;
}

}  // namespace stillpoint

#include <stillpoint/run.hpp>

#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "base/atomic_file.hpp"
#include "base/thread_team.hpp"
#include "output/history.hpp"
#include "output/report/report_page.hpp"
#include "output/report/run_report.hpp"
#include "output/run_folder.hpp"
#include "simulation/own_files.hpp"
#include "simulation/parts.hpp"

namespace stillpoint {
namespace {

BodyMoment now(const Simulation& simulation) {
  return moment_of(simulation.parts().phase, simulation.t(), simulation.u(), simulation.v());
}

// Returns the summary of a run that had to end before it began, which is not written yet. A history of no rows is
// written if the run begins anew; a run that is resumed has its own.
Summary leave_stopped_set_up(const Problem& problem, const SimulationOptions& options, const SetUpStopped& stopped) {
  const bool resumes = !options.resume.empty();
  if (const auto folder = own_folder(options); options.records && !folder.empty()) {
    const auto lock = prepare_folder(folder, resumes);
    if (!resumes) History(folder, {}).finish();
  }
  Summary s;
  s.scene = problem.name;
  s.title = problem.title;
  s.status = stopped.status();
  s.reason = stopped.what();
  s.exit_status = 3;
  s.t = resumes ? std::numeric_limits<double>::quiet_NaN() : 0;
  s.residual = s.kinetic_energy = s.omega_max = std::numeric_limits<double>::quiet_NaN();
  s.threads = options.threads > 0 ? options.threads : loop_threads();
  s.wall_s = stopped.wall_s();
  s.method = problem.solve.method;
  if (problem.solve.is_static()) return s;
  s.integrator = problem.integrator.method;
  s.damping = problem.damping.strategy;
  return s;
}

// lock: it locks the folder from when the run begins.
// has_begun: set to whether the run got beyond its set-up.
Summary simulate(const Scene& scene, const SimulationOptions& options, RunReport& report,
                 std::shared_ptr<FolderLock>& lock, bool& has_begun) {
  has_begun = true;
  try {
    Simulation simulation(scene, options);
    if (const auto folder = own_folder(options); !folder.empty()) lock = lock_folder(folder);
    if (report.looks_at_body()) report.begin(now(simulation));
    simulation.run();
    if (report.looks_at_body() && simulation.parts().is_readable) report.end(now(simulation));
    return simulation.summary();
  } catch (const SetUpStopped& stopped) {
    has_begun = false;
    return leave_stopped_set_up(scene, options, stopped);
  }
}

}  // namespace

Summary run(const Scene& scene, const SimulationOptions& options) {
  std::shared_ptr<FolderLock> lock;
  const std::filesystem::path folder = own_folder(options);
  if (std::filesystem::is_directory(folder)) lock = lock_folder(folder);  // before a set-up, which may be long
  RunReport report(scene, options.out);
  bool has_begun = false;
  Summary summary = simulate(scene, options, report, lock, has_begun);
  if (!folder.empty()) {
    const std::string json = to_json(summary), page = report.page(summary);  // before either is written
    write_file(folder / "summary.json", json);
    write_file(folder / report_name, page);
  }
  // In a set-up each rank hears for itself that it is to end, and others may wait for it.
  if (options.ranks && !has_begun) options.ranks->fails_with_all(summary.exit_status, "stillpoint: " + summary.reason);
  return summary;
}

}  // namespace stillpoint

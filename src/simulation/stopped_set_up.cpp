#include "simulation/stopped_set_up.hpp"

#include <limits>

#include <omp.h>

#include "output/history.hpp"
#include "output/run_folder.hpp"
#include "simulation/catalogue.hpp"

namespace stillpoint {

Summary leave_stopped_set_up(const Problem& problem, const SimulationOptions& options, const SetUpStopped& stopped) {
  const bool resumes = !options.resume.empty();
  if (options.records && !options.out.empty()) {
    const auto lock = prepare_folder(options.out, resumes);
    if (!resumes) History(options.out, {}).finish();
  }
  Summary s;
  s.scene = problem.name;
  s.title = problem.title;
  s.status = stopped.status();
  s.reason = stopped.what();
  s.exit_status = 3;
  s.t = resumes ? std::numeric_limits<double>::quiet_NaN() : 0;
  s.residual = s.kinetic_energy = s.omega_max = std::numeric_limits<double>::quiet_NaN();
  s.threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  s.wall_s = stopped.wall_s();
  s.method = problem.solve.method;
  if (problem.solve.is_static()) return s;
  s.integrator = problem.integrator.method;
  s.damping = problem.damping.strategy;
  return s;
}

}  // namespace stillpoint

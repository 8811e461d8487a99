
#include <stillpoint/simulation.hpp>

#include <cmath>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "plan/catalogue.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "study/benchmark_run.hpp"
#include "study/setting.hpp"

namespace stillpoint {
namespace {

struct Ended {
  Summary summary;
  ComparedRun set_up;  // only its set-up is filled in
  std::vector<double> displacement;
};

Ended follow(Scene scene, int threads, SetUpStore& store, const std::function<bool()>& interrupted = {}) {
  scene.output.snapshots.clear();
  scene.output.fields_every = 0;
  scene.output.every = scene.stop.time;  // an output row costs time, and changes the steps
  const Stopwatch watch;
  Simulation simulation(scene, {.threads = threads, .interrupted = interrupted, .store = &store});
  ComparedRun set_up;
  fill_set_up(simulation.parts().model, watch.seconds(), set_up);
  simulation.run();
  const ConstVec u = simulation.field("u");
  return {simulation.summary(), std::move(set_up), {u.begin(), u.end()}};
}

double stepping_s(const Summary& s) {
  return 1e-9 * s.ns_per_point_step * static_cast<double>(s.steps) * static_cast<double>(s.points);
}

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return difference == 0 ? 0 : std::sqrt(difference / size);
}

}  // namespace

TransientReference transient_reference(const Scene& scene, SetUpStore& store) {
  std::unique_ptr<LagrangianPhase> phase = store.phase(scene).phase;
  const StrategyInfo& strategy = *catalogue().strategy(scene.damping.strategy);
  const bool smooth = !phase->history_dependent() && !phase->contact() && !phase->info().updated_lagrangian &&
                      !strategy.is_local && !strategy.is_relaxation;
  store.give_back(scene.mass, std::move(phase));
  const Scene accurate = changed(scene, [smooth](Problem& problem) {
    problem.integrator.step.reset();
    problem.integrator.method = smooth ? "erk:fehlberg-13-7-8" : "leapfrog";
    problem.integrator.rtol = smooth ? std::optional(1e-11) : std::nullopt;
    if (!smooth) problem.integrator.step_fraction = 1.0 / 16;
  });
  Ended ended = follow(accurate, 0, store);
  if (ended.summary.status != RunStatus::end_time) {
    throw std::runtime_error("the reference of the transient did not reach stop.time: " + ended.summary.reason);
  }
  return {std::move(ended.displacement),
          smooth ? "erk:fehlberg-13-7-8 at rtol 1e-11" : "leapfrog at a sixteenth of the critical step"};
}

double run_transient(const Scene& scene, const TransientReference& reference, int threads,
                     const std::function<bool()>& interrupted, SetUpStore& store, ComparedRun& run) {
  const Ended ended = follow(scene, threads, store, interrupted);
  run.setup_s = ended.set_up.setup_s;
  run.setup_parts = ended.set_up.setup_parts;
  run.steps = ended.summary.steps;
  run.evaluations = run.first_evaluations = ended.summary.rhs_evaluations;
  run.residual = ended.summary.residual;
  run.reason = ended.summary.reason;
  switch (ended.summary.status) {
    case RunStatus::end_time:
      run.status = ComparedStatus::converged;
      break;
    case RunStatus::interrupted:
      run.status = ComparedStatus::interrupted;
      return 0;
    default:
      run.status = ComparedStatus::diverged;
      return 0;
  }
  run.error = relative_difference(ended.displacement, reference.displacement);
  run.samples.push_back({run.evaluations, run.error, run.residual, std::nullopt});
  const double seconds = stepping_s(ended.summary);
  if (run.error < 1) return seconds;  // false for NaN as well
  run.status = ComparedStatus::inaccurate;
  run.reason = fmt::format("error {:.3g} at t = {:.6g}: as large as the displacement", run.error, ended.summary.t);
  return seconds;
}

double time_transient(const Scene& scene, int threads, SetUpStore& store) {
  return stepping_s(follow(scene, threads, store).summary);
}

}  // namespace stillpoint

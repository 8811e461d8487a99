#include "study/transient_run.hpp"

#include <stillpoint/simulation.hpp>

#include <cmath>

#include <fmt/format.h>

#include "simulation/catalogue.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {
namespace {

struct Ended {
  Summary summary;
  std::vector<double> displacement;
};

Ended follow(Scene scene, int threads, const std::function<bool()>& interrupted = {}) {
  scene.output.snapshots.clear();
  scene.output.fields_every = 0;
  scene.output.every = scene.stop.time;  // a row costs time, and bends the steps
  Simulation simulation(scene, {.threads = threads, .interrupted = interrupted});
  simulation.run();
  const ConstVec u = simulation.field("u");
  return {simulation.summary(), {u.begin(), u.end()}};
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

TransientReference transient_reference(const Scene& scene,
                                       const std::function<Scene(const std::vector<std::string>&)>& load) {
  const auto phase = make_phase(scene);
  const StrategyInfo& strategy = *catalogue().strategy(scene.damping.strategy);
  const bool smooth = !phase->history_dependent() && !phase->contact() && !phase->info().updated_lagrangian &&
                      !strategy.is_local && !strategy.is_relaxation;
  const std::vector<std::string> overrides =
      smooth ? std::vector<std::string>{"integrator.method=erk:fehlberg-13-7-8", "integrator.rtol=1e-11"}
             : std::vector<std::string>{"integrator.method=leapfrog", "integrator.step_fraction=0.0625"};
  Ended ended = follow(load(overrides), 0);
  if (ended.summary.status != RunStatus::end_time) {
    throw std::runtime_error("the reference of the transient did not reach stop.time: " + ended.summary.reason);
  }
  return {std::move(ended.displacement),
          smooth ? "erk:fehlberg-13-7-8 at rtol 1e-11" : "leapfrog at a sixteenth of the critical step"};
}

void run_transient(const Scene& scene, const TransientReference& reference, const std::function<bool()>& interrupted,
                   ComparedRun& run) {
  const Ended ended = follow(scene, 1, interrupted);
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
      return;
    default:
      run.status = ComparedStatus::diverged;
      return;
  }
  run.error = relative_difference(ended.displacement, reference.displacement);
  run.samples.push_back({run.evaluations, run.error, run.residual, std::nullopt});
  if (run.error < 1) return;  // false for NaN as well
  run.status = ComparedStatus::inaccurate;
  run.reason = fmt::format("error {:.3g} at t = {:.6g}: as large as the displacement", run.error, ended.summary.t);
}

double time_transient(const Scene& scene, int threads) {
  const Summary s = follow(scene, threads).summary;
  return 1e-9 * s.ns_per_point_step * static_cast<double>(s.steps) * static_cast<double>(s.points);
}

}  // namespace stillpoint

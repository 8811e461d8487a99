#include "study/benchmark_run.hpp"

#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "simulation/model.hpp"

namespace stillpoint {
namespace {

/// Where the way to the goal was for good, and whether it still leads anywhere.
class ConvergenceTracker {
 public:
  explicit ConvergenceTracker(double goal) : goal_(goal) {}

  void sample(long steps, long evaluations, double measure) {
    if (measure <= goal_) {
      if (inside_steps_ == 0) inside_steps_ = steps, inside_evaluations_ = evaluations;
      if (first_ == 0) first_ = evaluations;
    } else {
      inside_steps_ = inside_evaluations_ = 0;
    }
    if (evaluations >= next_mark_) {
      half_way_best_ = earlier_best_;
      earlier_best_ = best_;
      next_mark_ = 2 * evaluations;
    }
    best_ = std::min(best_, measure);
  }
  /// Below the goal for a tenth of the way again, so that an error that swings through it does not count.
  bool arrived(long evaluations) const {
    return inside_evaluations_ > 0 && evaluations - inside_evaluations_ >= std::max(50L, inside_evaluations_ / 10);
  }
  bool stalled() const { return best_ > 0.5 * half_way_best_; }
  long first() const { return first_; }
  long steps() const { return inside_steps_; }
  long evaluations() const { return inside_evaluations_; }

 private:
  double goal_;
  long inside_steps_ = 0, inside_evaluations_ = 0, first_ = 0;
  long next_mark_ = 64;
  double best_ = std::numeric_limits<double>::infinity(), earlier_best_ = best_, half_way_best_ = best_;
};

// Points, and about ten vectors of unknowns.
std::size_t memory_of(const LagrangianPhase& phase) {
  return static_cast<std::size_t>(10.0 * sizeof(double) * static_cast<double>(phase.size()) +
                                  phase.bytes_per_point() * static_cast<double>(phase.points()));
}

// Steps as the method takes them by itself, with no end but a failure.
Simulation free_running(const Scene& scene, int threads) {
  return Simulation(scene, {.threads = threads, .records = false, .stops = false});
}

}  // namespace

void run_benchmark(const Scene& scene, const ReferenceSolution& exact, const BenchmarkLimits& limits,
                   ComparedRun& run) {
  const Stopwatch setup;
  Simulation simulation = free_running(scene, 1);
  run.setup_s = setup.seconds();
  run.estimating = simulation.model().tangent_applications;
  run.memory_bytes = memory_of(simulation.phase());

  const Stopwatch wall;
  ConvergenceTracker tracker(limits.goal);
  long next_sample = 0;
  const auto evaluations = [&] { return simulation.evaluations() + run.estimating; };
  const auto sample = [&] {
    run.residual = simulation.residual();
    run.error = exact.error(simulation.u());
    run.distance = simulation.distance();
    const double measure = limits.by_residual ? run.residual : run.error;
    tracker.sample(simulation.steps(), evaluations(), simulation.loads_settled() ? measure : 1);
    if (evaluations() < next_sample) return;
    run.samples.push_back({evaluations(), run.error, run.residual, run.distance});
    next_sample = evaluations() + 1 + evaluations() / 50;
  };
  const auto end = [&](ComparedStatus status, std::string reason) {
    run.status = status;
    run.reason = std::move(reason);
    run.steps = simulation.steps();
    run.evaluations = evaluations();
    run.first_evaluations = tracker.first();
    if (limits.ramp) run.overshoot = limits.ramp->error(simulation.u());
    if (status != ComparedStatus::converged) return;
    run.steps = tracker.steps();
    run.evaluations = tracker.evaluations();
  };

  sample();
  const char* what = limits.by_residual ? "residual" : "error";
  while (true) {
    if (simulation.step() != RunStatus::running) {
      // An iteration that cannot get any nearer for rounding has arrived where it could.
      const bool arrived = tracker.evaluations() > 0;
      return end(arrived ? ComparedStatus::converged : ComparedStatus::diverged, simulation.reason());
    }
    sample();
    if (!std::isfinite(run.residual) || !std::isfinite(run.error) || run.error > 1e6) {
      return end(ComparedStatus::diverged, fmt::format("error {:.3g} at t = {:.6g}", run.error, simulation.t()));
    }
    if (tracker.arrived(evaluations())) {
      return end(ComparedStatus::converged, fmt::format("{} <= {:.3g}", what, limits.goal));
    }
    const bool late = wall.seconds() > limits.seconds;
    if (late || evaluations() > limits.evaluations) {
      const std::string reason =
          fmt::format("{} {:.3g} after {}", what, limits.by_residual ? run.residual : run.error,
                      late ? fmt::format("{:.3g} s", limits.seconds) : fmt::format("{} evaluations", evaluations()));
      return end(tracker.stalled() ? ComparedStatus::stalled : ComparedStatus::unfinished, reason);
    }
    if (limits.interrupted && limits.interrupted()) return end(ComparedStatus::interrupted, "by the user");
  }
}

double time_benchmark(const Scene& scene, long steps, int threads) {
  Simulation simulation = free_running(scene, threads);
  const Stopwatch wall;
  while (simulation.steps() < steps && !simulation.done()) simulation.step();
  return wall.seconds();
}

}  // namespace stillpoint

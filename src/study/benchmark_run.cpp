#include "study/benchmark_run.hpp"

#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "base/thread_team.hpp"
#include "simulation/parts.hpp"

namespace stillpoint {
namespace {

/// Records when the goal was met for good, and whether the run still makes progress.
class ConvergenceTracker {
 public:
  explicit ConvergenceTracker(double goal) : goal_(goal) {}

  /// counts: whether the loads have reached their final values; before that the goal cannot be met.
  void sample(long steps, long evaluations, double seconds, double seen, bool counts) {
    last_but_one_ = std::exchange(last_, seen);
    const double measure = counts ? seen : 1;
    if (measure <= goal_) {
      if (inside_steps_ == 0) inside_steps_ = steps, inside_evaluations_ = evaluations, inside_seconds_ = seconds;
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
  /// Whether the next state may be at the goal, or may have gone wrong: each of these is measured, so that the step at
  /// which the goal is met is known exactly. Further off, a few measurements in a hundred steps are enough, unless the
  /// error falls so fast from one to the next that the goal may lie between.
  bool looks_closely() const {
    constexpr double near = 100, worse_than_nothing = 2;
    const double next = last_ * std::min(1.0, last_ / last_but_one_);
    return !(next > near * goal_ && last_ < worse_than_nothing);
  }
  /// Whether the run has stayed below the goal for a tenth of the way again, so that an error that swings through it
  /// does not count.
  bool arrived(long evaluations) const {
    return inside_evaluations_ > 0 && evaluations - inside_evaluations_ >= std::max(50L, inside_evaluations_ / 10);
  }
  bool stalled() const { return best_ > 0.5 * half_way_best_; }
  long first() const { return first_; }
  long steps() const { return inside_steps_; }
  long evaluations() const { return inside_evaluations_; }
  double seconds() const { return inside_seconds_; }

 private:
  double goal_;
  long inside_steps_ = 0, inside_evaluations_ = 0, first_ = 0;
  double inside_seconds_ = 0;
  long next_mark_ = 64;
  double last_ = 1, last_but_one_ = 1;
  double best_ = std::numeric_limits<double>::infinity(), earlier_best_ = best_, half_way_best_ = best_;
};

// The memory of the points and about ten vectors of unknowns [bytes].
std::size_t memory_of(const LagrangianPhase& phase) {
  return static_cast<std::size_t>(10.0 * sizeof(double) * static_cast<double>(phase.size()) +
                                  phase.shape().discretisation().bytes_per_point() *
                                      static_cast<double>(phase.points()));
}

// A simulation that steps by the method alone, with no end but a failure.
Simulation free_running(const Scene& scene, int threads, SetUpStore& store) {
  return Simulation(scene, {.threads = threads, .records = false, .stops = false, .store = &store});
}

/// One run and its measurements.
class Benchmark {
 public:
  Benchmark(const Scene& scene, const ReferenceSolution& exact, const BenchmarkLimits& limits, SetUpStore& store,
            ComparedRun& run)
      : exact_(exact),
        limits_(limits),
        run_(run),
        simulation_(free_running(scene, limits.threads, store)),
        set_up_s_(wall_.seconds()),
        tracker_(limits.goal) {
    fill_set_up(simulation_.parts().model, set_up_s_, run_);
    run_.estimating = simulation_.parts().model.tangent_applications;
    run_.memory_bytes = memory_of(simulation_.parts().phase);
  }

  double run() {
    look(true);
    while (!is_over()) {
      const Stopwatch watch;
      const RunStatus status = simulation_.step();
      stepping_s_ += watch.seconds();
      if (status != RunStatus::running) {
        // An iteration that rounding keeps from getting any nearer has converged as far as it can.
        const bool arrived = tracker_.evaluations() > 0;
        end(arrived ? ComparedStatus::converged : ComparedStatus::diverged, simulation_.reason());
        break;
      }
      look(false);
    }
    return run_.status == ComparedStatus::converged ? tracker_.seconds() : stepping_s_;
  }

 private:
  long evaluations() const { return simulation_.evaluations() + run_.estimating; }

  // Samples the run, evenly spaced by the logarithm of the evaluations; near the goal it measures more often.
  void look(bool at_start) {
    const bool due = at_start || evaluations() >= next_sample_;
    if (!due && !tracker_.looks_closely()) return;
    measure(due);
    tracker_.sample(simulation_.steps(), evaluations(), stepping_s_, measured(), simulation_.loads_settled());
    if (!due) return;
    run_.samples.push_back({evaluations(), run_.error, run_.residual, run_.distance});
    next_sample_ = evaluations() + 1 + evaluations() / 50;
  }
  double measured() const { return limits_.by_residual ? run_.residual : run_.error; }
  void measure(bool all) {
    if (all || limits_.by_residual) run_.residual = simulation_.residual();
    {
      const ThreadScope threads(std::max(1, limits_.threads));  // a short loop, which other threads may hold up
      run_.error = exact_.error(simulation_.u());
    }
    if (all) run_.distance = simulation_.distance();
  }

  bool is_over() {
    const char* what = limits_.by_residual ? "residual" : "error";
    const bool finite = std::isfinite(run_.error) && std::isfinite(run_.residual);
    if (!finite || run_.error > 1e6) {
      return end(ComparedStatus::diverged, fmt::format("error {:.3g} at t = {:.6g}", run_.error, simulation_.t()));
    }
    if (tracker_.arrived(evaluations()))
      return end(ComparedStatus::converged, fmt::format("{} <= {:.3g}", what, limits_.goal));
    const bool late = wall_.seconds() - set_up_s_ > limits_.seconds;
    if (late || evaluations() > limits_.evaluations) {
      measure(true);
      const std::string reason =
          fmt::format("{} {:.3g} after {}", what, measured(),
                      late ? fmt::format("{:.3g} s", limits_.seconds) : fmt::format("{} evaluations", evaluations()));
      return end(tracker_.stalled() ? ComparedStatus::stalled : ComparedStatus::unfinished, reason);
    }
    return limits_.interrupted && limits_.interrupted() && end(ComparedStatus::interrupted, "by the user");
  }

  bool end(ComparedStatus status, std::string reason) {
    measure(true);
    run_.status = status;
    run_.reason = std::move(reason);
    run_.steps = simulation_.steps();
    run_.evaluations = evaluations();
    run_.first_evaluations = tracker_.first();
    if (limits_.ramp) run_.overshoot = limits_.ramp->error(simulation_.u());
    if (status == ComparedStatus::converged) {
      run_.steps = tracker_.steps();
      run_.evaluations = tracker_.evaluations();
    }
    return true;
  }

  const ReferenceSolution& exact_;
  const BenchmarkLimits& limits_;
  ComparedRun& run_;
  const Stopwatch wall_;
  Simulation simulation_;
  double set_up_s_, stepping_s_ = 0;
  ConvergenceTracker tracker_;
  long next_sample_ = 0;
};

}  // namespace

double run_benchmark(const Scene& scene, const ReferenceSolution& exact, const BenchmarkLimits& limits,
                     SetUpStore& store, ComparedRun& run) {
  return Benchmark(scene, exact, limits, store, run).run();
}

double time_benchmark(const Scene& scene, long steps, int threads, SetUpStore& store) {
  Simulation simulation = free_running(scene, threads, store);
  const Stopwatch wall;
  while (simulation.steps() < steps && !simulation.done()) simulation.step();
  return wall.seconds();
}

void fill_set_up(const Model& model, double seconds, ComparedRun& run) {
  run.setup_s = seconds + model.spared_s;
  run.setup_parts.clear();
  for (const SetUpPart& part : model.parts) run.setup_parts.emplace_back(part.name, part.seconds);
}

}  // namespace stillpoint

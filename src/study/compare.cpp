#include <stillpoint/compare.hpp>
#include <stillpoint/spectrum.hpp>
#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numeric>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "simulation/thread_scope.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"
#include "solvers/statics/static_methods.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "study/benchmark_run.hpp"
#include "study/compare_candidates.hpp"
#include "study/reference_solution.hpp"
#include "study/side_by_side.hpp"
#include "study/transient_run.hpp"

namespace stillpoint {

std::string to_string(ComparedStatus status) {
  switch (status) {
    case ComparedStatus::converged:
      return "converged";
    case ComparedStatus::stalled:
      return "stalled";
    case ComparedStatus::unfinished:
      return "unfinished";
    case ComparedStatus::inaccurate:
      return "inaccurate";
    case ComparedStatus::diverged:
      return "diverged";
    case ComparedStatus::refused:
      return "refused";
    case ComparedStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

std::string ComparedRun::label() const {
  std::string text = strategy;
  if (!integrator.empty() && integrator != IntegratorSpec{}.method) text += ", " + integrator;
  if (step_fraction) text += fmt::format(" {:g}", *step_fraction);
  if (rtol) text += fmt::format(" rtol {:g}", *rtol);
  return text;
}

std::optional<double> Comparison::over_chebyshev_estimate(const ComparedRun& run) const {
  if (!chebyshev_estimate || run.evaluations == 0) return std::nullopt;
  return static_cast<double>(run.evaluations) / *chebyshev_estimate;
}

double chebyshev_estimate(double kappa, double error) { return 0.5 * std::sqrt(kappa) * std::log(2 / error); }

namespace {

Spread spread_of(std::vector<double> values) {
  std::ranges::sort(values);
  return {values[values.size() / 2], values.front(), values.back()};
}

/// One comparison, from the scene to its rows.
class Comparing {
 public:
  Comparing(std::filesystem::path scene, std::vector<std::string> overrides, const CompareOptions& options)
      : file_(std::move(scene)), overrides_(std::move(overrides)), options_(options), scene_(load({})) {
    result_.scene = scene_.name;
    result_.title = scene_.title;
    result_.goal = options_.goal;
    result_.threads = options_.threads > 0 ? options_.threads : omp_get_max_threads();
    result_.transient = scene_.stop.time > 0 && !scene_.stop.wants_equilibrium();
    candidates_ = candidates(options_, scene_, result_.transient);
  }

  Comparison compare() {
    const ThreadScope threads(result_.threads);
    total_ = static_cast<int>(candidates_.size());
    find_reference();
    count();
    time();
    for (Candidate& candidate : candidates_) result_.runs.push_back(std::move(candidate.run));
    return std::move(result_);
  }

 private:
  Scene load(const std::vector<std::string>& more) const {
    std::vector<std::string> all = overrides_;
    all.insert(all.end(), more.begin(), more.end());
    return load_scene(file_, all);
  }
  // What the user has set for strategies that take it stays out of the others.
  Scene load_for(const Candidate& candidate) const {
    std::vector<std::string> all;
    for (const std::string& given : overrides_) {
      if (takes(candidate.run.strategy, given.substr(0, given.find_first_of(" \t=")))) all.push_back(given);
    }
    all.insert(all.end(), candidate.overrides.begin(), candidate.overrides.end());
    return load_scene(file_, all);
  }
  double end_time() const { return scene_.stop.time; }

  // Without one nothing is compared: whoever interrupts this interrupts every candidate.
  void find_reference() {
    const StopScope scope(options_.interrupted);
    try {
      if (result_.transient) return find_transient_reference();
      find_equilibrium();
      measure_spectrum();
      if (options_.overshoot) find_ramp();
    } catch (const Stopped&) {
      result_.notes.push_back("interrupted by the user before there was a solution to compare with");
    }
  }

  void find_equilibrium() {
    Equilibrium found = stillpoint::find_equilibrium(scene_, result_.threads, options_.interrupted);
    result_.dofs = found.state.phase->size();
    result_.points = found.state.phase->points();
    result_.by_residual = !found.unique;
    result_.reference = found.method;
    result_.reference_residual = found.residual;
    std::ranges::move(found.notes, std::back_inserter(result_.notes));
    exact_.emplace(std::move(found.state));
  }

  // κ of the elastic tangent where the body comes to rest.
  void measure_spectrum() {
    const auto phase = make_phase(scene_);
    const FrequencyEstimate lowest = omega_1_by_inverse_iteration(*phase, end_time(), exact_->u);
    const FrequencyEstimate highest =
        phase->size() > direct_solver_limit
            ? omega_max_by_lanczos(*phase, end_time(), exact_->u, 40)
            : omega_max_by_power_iteration(*phase, end_time(), exact_->u, {.tolerance = 1e-6});
    if (!lowest.converged || !(highest.omega > 0)) {
      result_.notes.push_back("there is no Chebyshev estimate: " + (lowest.converged ? highest.status : lowest.status));
      return;
    }
    result_.omega_1 = lowest.omega;
    result_.omega_max = highest.omega;
    result_.kappa = std::pow(highest.omega / lowest.omega, 2);
    result_.chebyshev_estimate = chebyshev_estimate(*result_.kappa, options_.goal);
  }

  void find_ramp() {
    ramp_ = slow_ramp(scene_, result_.notes);
    if (ramp_) result_.ramp_difference = ramp_->error(exact_->u);
  }

  void find_transient_reference() {
    const auto phase = make_phase(scene_);
    result_.dofs = phase->size();
    result_.points = phase->points();
    transient_ = transient_reference(scene_, [&](const std::vector<std::string>& more) { return load(more); });
    result_.reference = transient_->what;
  }

  void count() {
    side_by_side(result_.threads, candidates_.size(), [&](std::size_t k) {
      try_candidate(candidates_[k]);
      tell(candidates_[k].run.label());
    });
  }

  void try_candidate(Candidate& candidate) const {
    if (is_interrupted()) {
      candidate.run.status = ComparedStatus::interrupted;
      return;
    }
    const StopScope scope(options_.interrupted);
    try {
      const Scene scene = load_for(candidate);
      if (result_.transient) {
        run_transient(scene, *transient_, options_.interrupted, candidate.run);
      } else if (candidate.is_newton) {
        solve(scene, candidate.run);
      } else {
        run_benchmark(scene, *exact_, limits(), candidate.run);
      }
    } catch (const SceneError& error) {
      candidate.run.status = ComparedStatus::refused;
      candidate.run.reason = error.problems().front().message;
    } catch (const std::invalid_argument& error) {  // as Newton's method, if walls touch
      candidate.run.status = ComparedStatus::refused;
      candidate.run.reason = error.what();
    } catch (const Stopped&) {
      candidate.run.status = ComparedStatus::interrupted;
      candidate.run.reason = "by the user";
    } catch (const std::exception& error) {
      candidate.run.status = ComparedStatus::diverged;
      candidate.run.reason = error.what();
    }
  }

  BenchmarkLimits limits() const {
    const double estimate = result_.chebyshev_estimate.value_or(10'000);
    return {.goal = options_.goal,
            .by_residual = result_.by_residual,
            .evaluations = static_cast<long>(std::max(1000.0, options_.limit * estimate)),
            .seconds = options_.seconds,
            .ramp = ramp_ ? &*ramp_ : nullptr,
            .interrupted = options_.interrupted};
  }

  // Newton's method from the scene's start to the goal.
  void solve(const Scene& scene, ComparedRun& run) const {
    const Stopwatch setup;
    const auto phase = make_phase(scene);
    run.setup_s = setup.seconds();
    std::vector<double> u = phase->initial_displacement(end_time());
    NewtonOptions newton_options;
    newton_options.solver = linear_solver_of(run.strategy);
    // An error below the goal needs a residual that is smaller by up to κ: as far as rounding goes.
    newton_options.tolerance = result_.by_residual ? options_.goal : std::max(1e-3 * options_.goal, reference_residual);
    const StaticReport report = newton(*phase, end_time(), u, newton_options);
    run.status = report.converged ? ComparedStatus::converged : ComparedStatus::diverged;
    run.reason = report.reason;
    run.steps = report.iterations;
    run.evaluations = report.force_evaluations + report.tangent_products;
    run.first_evaluations = run.evaluations;
    run.residual = report.residual;
    run.error = exact_->error(u);
    if (ramp_) run.overshoot = ramp_->error(u);
    run.memory_bytes =
        static_cast<std::size_t>(phase->bytes_per_point() * static_cast<double>(phase->points())) + report.factor_bytes;
    run.wall_s = spread_of({report.wall_s});
  }

  // Those that arrived, in random order, so that what the machine does meanwhile falls on all alike.
  void time() {
    std::vector<std::size_t> jobs;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (candidates_[k].run.status != ComparedStatus::converged) continue;
      jobs.insert(jobs.end(), static_cast<std::size_t>(std::max(0, options_.repeats)), k);
    }
    std::shuffle(jobs.begin(), jobs.end(), std::mt19937(options_.seed));
    total_ += static_cast<int>(jobs.size());
    std::vector<std::vector<double>> seconds(candidates_.size());
    for (const std::size_t k : jobs) {
      if (is_interrupted()) break;
      Candidate& candidate = candidates_[k];
      constexpr double enough = 3;  // seconds of one candidate: a long run says by itself how long it takes
      if (std::reduce(seconds[k].begin(), seconds[k].end()) > enough) {
        --total_;
        continue;
      }
      const Scene scene = load_for(candidate);
      if (candidate.is_newton) {
        ComparedRun again = candidate.run;
        solve(scene, again);
        seconds[k].push_back(again.wall_s->median);
      } else if (result_.transient) {
        seconds[k].push_back(time_transient(scene, result_.threads));
      } else {
        seconds[k].push_back(time_benchmark(scene, candidate.run.steps, result_.threads));
      }
      tell("timing " + candidate.run.label());
    }
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (!seconds[k].empty()) candidates_[k].run.wall_s = spread_of(seconds[k]);
    }
  }

  bool is_interrupted() const { return options_.interrupted && options_.interrupted(); }
  void tell(const std::string& what) {
    const std::scoped_lock lock(telling_);
    ++done_;
    if (options_.progress) options_.progress({done_, total_, what, wall_.seconds()});
  }

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  const CompareOptions& options_;
  Scene scene_;
  Comparison result_;
  std::vector<Candidate> candidates_;
  std::optional<ReferenceSolution> exact_, ramp_;
  std::optional<TransientReference> transient_;
  Stopwatch wall_;
  std::mutex telling_;
  int done_ = 0, total_ = 0;
};

}  // namespace

Comparison compare(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                   const CompareOptions& options) {
  return Comparing(scene, overrides, options).compare();
}

}  // namespace stillpoint

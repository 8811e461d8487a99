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
#include "base/thread_team.hpp"
#include "plan/problem_size.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/setup/multigrid_mass.hpp"
#include "simulation/setup/set_up_store.hpp"
#include "simulation/thread_choice.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"
#include "solvers/statics/static_methods.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "study/benchmark_run.hpp"
#include "study/compare_candidates.hpp"
#include "study/reference_solution.hpp"
#include "study/side_by_side.hpp"

namespace stillpoint {

namespace {

Spread spread_of(std::vector<double> values) {
  std::ranges::sort(values);
  return {values[values.size() / 2], values.front(), values.back()};
}

/// One comparison, from the scene to its rows.
class Comparing {
 public:
  Comparing(const Scene& scene, const CompareOptions& options) : options_(options), scene_(scene) {
    result_.scene = scene_.name;
    result_.title = scene_.title;
    result_.scene_text = scene_.text;
    result_.overrides = scene_.overrides;
    result_.goal = options_.goal;
    result_.threads = options_.threads > 0 ? options_.threads : loop_threads();
    result_.chooses_threads = options_.threads == 0 && result_.threads > 1;
    result_.transient = scene_.stop.time > 0 && !scene_.stop.wants_equilibrium();
    candidates_ = candidates(options_, scene_, result_.transient);
  }

  Comparison compare() {
    threads_of_solvers_ = threads_to_begin_with(options_.threads, body_size(scene_).points);
    const ThreadScope threads(result_.threads);
    total_ = static_cast<int>(candidates_.size());
    seconds_.resize(candidates_.size());
    located(scene_, [&] { find_reference(); });
    count();
    time();
    for (Candidate& candidate : candidates_) {
      if (candidate.is_extra && candidate.run.status == ComparedStatus::refused) continue;
      result_.runs.push_back(std::move(candidate.run));
    }
    for (const std::vector<double>& times : seconds_) result_.timed_s += std::reduce(times.begin(), times.end());
    result_.wall_s = wall_.seconds();
    return std::move(result_);
  }

 private:
  double end_time() const { return scene_.stop.time; }

  // Without a reference nothing is compared: an interrupt here is an interrupt of every candidate.
  void find_reference() {
    const StopScope scope(options_.interrupted);
    const ThreadScope threads(threads_of_solvers_);
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
    Equilibrium found = stillpoint::find_equilibrium(scene_, options_.threads, options_.interrupted, store_);
    result_.dofs = found.state.u().size();
    result_.points = found.points;
    result_.by_residual = !found.unique;
    result_.reference = found.method;
    result_.reference_residual = found.residual;
    std::ranges::move(found.notes, std::back_inserter(result_.notes));
    exact_.emplace(std::move(found.state));
  }

  // κ of the elastic tangent at equilibrium. In a linear body that is the tangent at the start, whose ω₁ the runs need
  // as well.
  void measure_spectrum() {
    std::unique_ptr<LagrangianPhase> phase = store_.phase(scene_).phase;
    const std::vector<double>& u = exact_->u();
    const auto omega_1_at_rest = [&] { return omega_1_by_lanczos(*phase, end_time(), u); };
    const FrequencyEstimate lowest =
        phase->info().nonlinear ? omega_1_at_rest() : SetUp(&store_).shared(part_omega_1, scene_.mass, omega_1_at_rest);
    const FrequencyEstimate highest = phase->size() > direct_solver_limit
                                          ? omega_max_by_lanczos(*phase, end_time(), u, 40)
                                          : omega_max_by_power_iteration(*phase, end_time(), u, {.tolerance = 1e-6});
    store_.give_back(scene_.mass, std::move(phase));
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
    ramp_ = slow_ramp(scene_, store_, result_.notes);
    if (ramp_) result_.ramp_difference = ramp_->error(exact_->u());
  }

  void find_transient_reference() {
    std::unique_ptr<LagrangianPhase> phase = store_.phase(scene_).phase;
    result_.dofs = phase->size();
    result_.points = phase->points();
    store_.give_back(scene_.mass, std::move(phase));
    transient_ = transient_reference(scene_, store_);
    result_.reference = transient_->what;
  }

  // Runs of a small body are counted side by side, and timed later. A run of a large body keeps all cores busy, and may
  // as well be timed at once.
  void count() {
    constexpr std::size_t large_body = 20'000;
    const bool one_by_one = result_.points > large_body || result_.threads == 1;
    side_by_side(one_by_one ? 1 : result_.threads, candidates_.size(), [&](std::size_t k) {
      const double seconds = try_candidate(candidates_[k], one_by_one ? options_.threads : 1);
      const bool is_timed = one_by_one && options_.repeats > 0;
      if (is_timed && candidates_[k].run.status == ComparedStatus::converged) seconds_[k].push_back(seconds);
      tell(candidates_[k].run.label());
    });
  }

  // Returns the wall time of the candidate's steps [s].
  double try_candidate(Candidate& candidate, int threads) {
    if (is_interrupted()) {
      candidate.run.status = ComparedStatus::interrupted;
      return 0;
    }
    const StopScope scope(options_.interrupted);
    try {
      const Scene scene = scene_of(candidate.run, scene_);
      const ThreadScope all(threads > 0 ? threads : result_.threads);  // the run may use fewer
      if (result_.transient)
        return run_transient(scene, *transient_, threads, options_.interrupted, store_, candidate.run);
      if (candidate.is_newton) return solve(scene, threads > 0 ? threads : threads_of_solvers_, candidate.run);
      return run_benchmark(scene, *exact_, limits(threads), store_, candidate.run);
    } catch (const SceneError& error) {
      candidate.run.status = ComparedStatus::refused;
      candidate.run.reason = error.problems().front().message;
    } catch (const std::invalid_argument& error) {  // for example from Newton's method, if walls touch the body
      candidate.run.status = ComparedStatus::refused;
      candidate.run.reason = error.what();
    } catch (const Stopped&) {
      candidate.run.status = ComparedStatus::interrupted;
      candidate.run.reason = "by the user";
    } catch (const std::exception& error) {
      candidate.run.status = ComparedStatus::diverged;
      candidate.run.reason = error.what();
    }
    return 0;
  }

  BenchmarkLimits limits(int threads) const {
    const double estimate = result_.chebyshev_estimate.value_or(10'000);
    return {.goal = options_.goal,
            .by_residual = result_.by_residual,
            .evaluations = static_cast<long>(std::max(1000.0, options_.limit * estimate)),
            .seconds = options_.seconds,
            .threads = threads,
            .ramp = ramp_ ? &*ramp_ : nullptr,
            .interrupted = options_.interrupted};
  }

  // Solves by Newton's method from the scene's start to the goal.
  double solve(const Scene& scene, int threads, ComparedRun& run) {
    const ThreadScope scope(threads);
    auto [phase, setup_s, made_now] = store_.phase(scene);
    run.setup_s = setup_s;
    run.setup_parts = {{"phase", setup_s}};
    std::vector<double> u = phase->initial_displacement(end_time());
    NewtonOptions of_newton = newton_options(run.strategy, scene.solve.load_steps);
    const bool is_multigrid = scene.mass.kind == MassKind::multigrid;
    const auto multigrid = is_multigrid ? find_multigrid(scene, *phase, u, run) : nullptr;
    if (multigrid) precondition(of_newton, multigrid->mass);
    // An error below the goal needs a residual that is smaller by up to κ, as far as rounding allows.
    of_newton.tolerance = result_.by_residual ? options_.goal : std::max(1e-3 * options_.goal, reference_residual);
    const StaticReport report = newton(*phase, end_time(), u, of_newton);
    run.status = report.converged ? ComparedStatus::converged : ComparedStatus::diverged;
    run.reason = report.reason;
    run.steps = report.iterations;
    run.evaluations = report.force_evaluations + report.tangent_products;
    run.first_evaluations = run.evaluations;
    run.residual = report.residual;
    run.error = exact_->error(u);
    if (ramp_) run.overshoot = ramp_->error(u);
    run.memory_bytes = static_cast<std::size_t>(phase->shape().discretisation().bytes_per_point() *
                                                static_cast<double>(phase->points())) +
                       report.factor_bytes;
    run.wall_s = spread_of({report.wall_s});
    store_.give_back(scene.mass, std::move(phase));
    return report.wall_s;
  }

  std::shared_ptr<const MultigridMass> find_multigrid(const Scene& scene, const LagrangianPhase& phase, ConstVec u,
                                                      ComparedRun& run) {
    SetUp set_up(&store_);
    const MultigridAttempt made = shared_multigrid_mass(set_up, scene.mass, phase, u, true);
    if (!made.mass) throw_scene_error("mass.kind", made.refusal);
    for (const SetUpPart& part : set_up.parts()) {
      run.setup_s += part.seconds;
      run.setup_parts.emplace_back(part.name, part.seconds);
    }
    return made.mass;
  }

  // Times the candidates that converged, in random order, so that other load on the machine affects all of them alike.
  void time() {
    std::vector<std::size_t> jobs;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (candidates_[k].run.status != ComparedStatus::converged) continue;
      const int left = options_.repeats - static_cast<int>(seconds_[k].size());
      jobs.insert(jobs.end(), static_cast<std::size_t>(std::max(0, left)), k);
    }
    std::shuffle(jobs.begin(), jobs.end(), std::mt19937(options_.seed));
    total_ += static_cast<int>(jobs.size());
    for (const std::size_t k : jobs) {
      if (is_interrupted()) break;
      Candidate& candidate = candidates_[k];
      constexpr double enough = 3;  // [s] for one candidate: one long run gives its time reliably
      if (std::reduce(seconds_[k].begin(), seconds_[k].end()) > enough) {
        --total_;
        continue;
      }
      const Scene scene = scene_of(candidate.run, scene_);
      if (candidate.is_newton) {
        ComparedRun again = candidate.run;
        seconds_[k].push_back(solve(scene, threads_of_solvers_, again));
      } else if (result_.transient) {
        seconds_[k].push_back(time_transient(scene, options_.threads, store_));
      } else {
        seconds_[k].push_back(time_benchmark(scene, candidate.run.steps, options_.threads, store_));
      }
      tell("timing " + candidate.run.label());
    }
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (!seconds_[k].empty()) candidates_[k].run.wall_s = spread_of(seconds_[k]);
    }
  }

  bool is_interrupted() const { return options_.interrupted && options_.interrupted(); }
  void tell(const std::string& what) {
    const std::scoped_lock lock(telling_);
    ++done_;
    if (options_.progress) options_.progress({done_, total_, what, wall_.seconds()});
  }

  const CompareOptions& options_;
  const Scene& scene_;
  Comparison result_;
  std::vector<Candidate> candidates_;
  std::vector<std::vector<double>> seconds_;  // wall times of each candidate [s]
  int threads_of_solvers_ = 1;
  SetUpStore store_;
  std::optional<ReferenceSolution> exact_, ramp_;
  std::optional<TransientReference> transient_;
  Stopwatch wall_;
  std::mutex telling_;
  int done_ = 0, total_ = 0;
};

}  // namespace

Comparison compare(const Scene& scene, const CompareOptions& options) { return Comparing(scene, options).compare(); }

}  // namespace stillpoint

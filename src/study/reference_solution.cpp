#include "study/reference_solution.hpp"

#include <stillpoint/simulation.hpp>
#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "linalg/sparse_lu.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/loads/load_schedule.hpp"

namespace stillpoint {
namespace {

constexpr double tight_in_motion = 1e-10;

// ‖a − b‖_M, in one pass if M is diagonal.
double mass_norm_of_difference(const Mass& mass, ConstVec a, ConstVec b) {
  const std::size_t n = a.size();
  const double* const a_ = a.data();
  const double* const b_ = b.data();
  if (mass.is_diagonal()) {
    return std::sqrt(sum_over(n, [=, m = mass.diagonal().data()](std::size_t i) {
      const double difference = a_[i] - b_[i];
      return m[i] * difference * difference;
    }));
  }
  std::vector<double> x(n), Mx(n);
  for_each_index(n, [=, x = x.data()](std::size_t i) { x[i] = a_[i] - b_[i]; });
  mass.apply(x, Mx);
  return std::sqrt(sum_over(n, [x = x.data(), Mx = Mx.data()](std::size_t i) { return x[i] * Mx[i]; }));
}

struct Found {
  std::vector<double> u;  // (n)
  std::string method;
  double residual = 0;
};

// The same scene for Newton's method, in which no time passes, so that its materials are not viscous.
Problem without_time(const Problem& problem) {
  Problem timeless = problem;
  timeless.solve.method = "newton";
  return timeless;
}

// Solves as accurately as rounding allows. Leaves the solution in the phase.
std::optional<Found> solve(const Problem& problem, LagrangianPhase& phase, std::vector<std::string>& notes) {
  constexpr double near_enough = 1e4 * reference_residual;
  std::vector<double> u = phase.initial_displacement(problem.stop.time);
  const StaticReport report =
      newton(phase, problem.stop.time, u, {.tolerance = reference_residual, .near_enough = near_enough});
  if (report.converged) {
    const bool by_lu = report.lu_factorisations > 0;
    return Found{std::move(u),
                 fmt::format("Newton's method, {}", by_lu ? SparseLu::library() : SparseCholesky::library()),
                 report.residual};
  }
  notes.push_back("Newton's method found no reference: " + report.reason);
  return std::nullopt;
}

Found relax(Scene scene, int threads, const std::function<bool()>& interrupted, SetUpStore& store,
            std::vector<std::string>& notes) {
  scene.stop.residual = tight_in_motion;
  scene.stop.distance = 0;
  scene.output.snapshots.clear();
  Simulation simulation(scene, {.threads = threads, .interrupted = interrupted, .store = &store});
  simulation.run();
  const Summary summary = simulation.summary();
  if (summary.status != RunStatus::equilibrium)
    notes.push_back(fmt::format("the reference is no equilibrium: {}", summary.reason));
  return {{simulation.u().begin(), simulation.u().end()},
          fmt::format("relaxation by {} damping", summary.damping),
          summary.residual};
}

}  // namespace

ReferenceSolution::ReferenceSolution(std::vector<double> u, Mass mass)
    : u_(std::move(u)),
      mass_(std::move(mass)),
      size_(mass_norm_of_difference(mass_, u_, std::vector<double>(u_.size()))) {}

double ReferenceSolution::error(ConstVec u) const { return mass_norm_of_difference(mass_, u, u_) / size_; }

Equilibrium find_equilibrium(const Scene& scene, int threads, const std::function<bool()>& interrupted,
                             SetUpStore& store) {
  std::unique_ptr<LagrangianPhase> phase = store.phase(without_time(scene)).phase;
  if (phase->info().updated_lagrangian) {
    throw_scene_error(
        "phase",
        "an equilibrium is compared on one set of unknowns, so in one phase; expected phase.max_motion = \"none\", "
        "or stop.residual = 0 and stop.time to compare the way to it");
  }
  if (scene.stop.time == 0 && loads_vary(scene)) {
    throw_scene_error(
        "stop.time",
        "loads or supports depend on t, and the equilibrium to compare with is that at the end; expected the t at "
        "which they have come to it");
  }
  const auto refuse = [&] {
    throw_scene_error("body_force",
                      "in equilibrium nothing is displaced, so that no error is relative; expected a load");
  };
  const std::vector<double> load = total_load_at(*phase, scene.stop.time);
  if (!phase->contact() && std::ranges::all_of(load, [](double force) { return force == 0; })) refuse();
  const bool unique = !phase->history_dependent() && !phase->contact();
  const std::size_t points = phase->points();
  const Mass mass = phase->mass();
  std::vector<std::string> notes;
  std::optional<Found> found;
  if (!phase->contact()) found = solve(scene, *phase, notes);
  store.give_back(scene.mass, std::move(phase));
  if (!found) found = relax(scene, threads, interrupted, store, notes);
  Equilibrium equilibrium{.state = {std::move(found->u), mass},
                          .points = points,
                          .method = found->method,
                          .residual = found->residual,
                          .unique = unique,
                          .notes = std::move(notes)};
  if (!(equilibrium.state.size() > 0)) refuse();  // for example if the walls do not move
  return equilibrium;
}

std::optional<ReferenceSolution> slow_ramp(const Problem& problem, SetUpStore& store, std::vector<std::string>& notes) {
  std::unique_ptr<LagrangianPhase> phase = store.phase(without_time(problem)).phase;
  if (phase->contact()) {
    notes.emplace_back("no slow ramp: Newton's method has no contact");
    return std::nullopt;
  }
  constexpr int steps = 64;
  std::vector<double> u = phase->initial_displacement(0);
  const StaticReport report =
      newton(*phase, problem.stop.time, u, {.tolerance = 1e-9, .load_steps = steps, .max_load_step = 1.0 / steps});
  const Mass mass = phase->mass();
  store.give_back(problem.mass, std::move(phase));
  if (report.converged) return ReferenceSolution(u, mass);
  notes.push_back(fmt::format("the slow ramp ends at {:.3g} of the load: {}", report.load_factor, report.reason));
  return std::nullopt;
}

}  // namespace stillpoint

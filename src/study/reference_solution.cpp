#include "study/reference_solution.hpp"

#include <stillpoint/simulation.hpp>
#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "simulation/load_schedule.hpp"

namespace stillpoint {
namespace {

constexpr double tight_in_motion = 1e-10;

double mass_norm(const Mass& mass, ConstVec x) {
  std::vector<double> Mx(x.size());
  mass.apply(x, Mx);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * Mx[i];
  return std::sqrt(sum);
}

// As near as rounding lets it come.
bool solve(const Scene& scene, Equilibrium& found) {
  std::string reason;
  for (const double tolerance : {reference_residual, 1e2 * reference_residual, 1e4 * reference_residual}) {
    const auto phase = make_phase(scene);
    std::vector<double> u = phase->initial_displacement(scene.stop.time);
    const StaticReport report = newton(*phase, scene.stop.time, u, {.tolerance = tolerance});
    reason = report.reason;
    if (!report.converged) continue;
    found.state.u = u;
    found.residual = report.residual;
    found.method = report.lu_factorisations > 0 ? "Newton's method, UMFPACK" : "Newton's method, CHOLMOD";
    return true;
  }
  found.notes.push_back("Newton's method found no reference: " + reason);
  return false;
}

void relax(Scene scene, int threads, const std::function<bool()>& interrupted, Equilibrium& found) {
  scene.stop.residual = tight_in_motion;
  scene.stop.distance = 0;
  scene.output.snapshots.clear();
  Simulation simulation(scene, {.threads = threads, .interrupted = interrupted});
  simulation.run();
  const Summary summary = simulation.summary();
  found.state.u.assign(simulation.u().begin(), simulation.u().end());
  found.method = fmt::format("relaxation by {} damping", summary.damping);
  found.residual = summary.residual;
  if (summary.status != RunStatus::equilibrium) {
    found.notes.push_back(fmt::format("the reference is no equilibrium: {}", summary.reason));
  }
}

}  // namespace

double ReferenceSolution::size() const { return mass_norm(phase->mass(), u); }

double ReferenceSolution::error(ConstVec at) const {
  std::vector<double> difference(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) difference[i] = at[i] - u[i];
  return mass_norm(phase->mass(), difference) / size();
}

Equilibrium find_equilibrium(const Scene& scene, int threads, const std::function<bool()>& interrupted) {
  const std::shared_ptr<LagrangianPhase> phase = make_phase(scene);
  if (phase->info().updated_lagrangian) {
    throw_scene_error(
        scene, "phase",
        "an equilibrium is compared on one set of unknowns, so in one phase; expected phase.max_motion = \"none\", "
        "or stop.residual = 0 and stop.time to compare the way to it");
  }
  if (scene.stop.time == 0 && loads_vary(scene)) {
    throw_scene_error(
        scene, "stop.time",
        "loads or supports depend on t, and the equilibrium to compare with is that at the end; expected the t at "
        "which they have come to it");
  }
  const auto refuse = [&] {
    throw_scene_error(scene, "body_force",
                      "in equilibrium nothing is displaced, so that no error is relative; expected a load");
  };
  const std::vector<double> load = total_load_at(*phase, scene.stop.time);
  if (!phase->contact() && std::ranges::all_of(load, [](double force) { return force == 0; })) refuse();
  Equilibrium found;
  found.state = {phase->initial_displacement(scene.stop.time), phase};
  found.unique = !phase->history_dependent() && !phase->contact();
  if (phase->contact() || !solve(scene, found)) relax(scene, threads, interrupted, found);
  if (!(found.state.size() > 0)) refuse();  // as where walls do not move
  return found;
}

std::optional<ReferenceSolution> slow_ramp(const Scene& scene, std::vector<std::string>& notes) {
  const std::shared_ptr<LagrangianPhase> phase = make_phase(scene);
  if (phase->contact()) {
    notes.emplace_back("no slow ramp: Newton's method has no contact");
    return std::nullopt;
  }
  constexpr int steps = 64;
  std::vector<double> u = phase->initial_displacement(0);
  const StaticReport report =
      newton(*phase, scene.stop.time, u, {.tolerance = 1e-9, .load_steps = steps, .max_load_step = 1.0 / steps});
  if (report.converged) return ReferenceSolution{u, phase};
  notes.push_back(fmt::format("the slow ramp ends at {:.3g} of the load: {}", report.load_factor, report.reason));
  return std::nullopt;
}

}  // namespace stillpoint

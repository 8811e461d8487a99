// The figures of a simulation, at any moment and at its end.
#include <limits>

#include "base/stop_request.hpp"
#include "output/exact_error.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/contact_figures.hpp"
#include "simulation/simulation_impl.hpp"
#include "simulation/support_figures.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"

namespace stillpoint {
namespace {

// The distance at the end, by the stiffness of then. In a large body that takes long: if the run is asked to end
// meanwhile, there is none.
void refresh_distance_in_time(RunState& run) {
  const StopScope scope(run.model.phase->size() > direct_solver_limit ? run.asks_to_end() : nullptr);
  try {
    run.measured.refresh_distance();
  } catch (const Stopped&) {
    run.measured.forget_distance();
  }
}

// The distance is a bound if the stiffness is constant, and nothing opens, closes or slides.
bool is_bound(const RunState& run) {
  const Model& model = run.model;
  return !model.phase->info().nonlinear && !model.learns_omega_1 && !model.phase->contact() &&
         !run.measured.creeping.way_left;
}

}  // namespace

int Simulation::Impl::exit_status() const {
  const StopSpec& stop = run_->scene.stop;
  const RunStatus status = verdict_.status;
  if (status == RunStatus::diverged || status == RunStatus::failed) return 4;
  const bool only_time_was_asked = !stop.wants_equilibrium() && !(stop.load_growth > 0);
  const bool as_asked = status == RunStatus::equilibrium || status == RunStatus::limit_load ||
                        status == RunStatus::stop_test || (status == RunStatus::end_time && only_time_was_asked);
  return as_asked ? 0 : 3;
}

Summary Simulation::Impl::summary() {
  Summary s;
  s.scene = run_->scene.name;
  s.title = run_->scene.title;
  s.status = verdict_.status;
  s.reason = verdict_.reason;
  s.exit_status = exit_status();
  s.notes = run_->model.notes;
  s.stages = stages_;
  const Model& model = run_->model;
  s.points = model.phase->points();
  s.dofs = model.phase->size();
  s.bytes_per_point = model.phase->shape().discretisation().bytes_per_point();
  s.omega_1 = model.omega_1;
  s.omega_max = model.omega_max;
  s.c = model.c ? model.c : run_->motion->stepper->damping_rate();
  s.critical_step = model.critical_step;
  s.method = run_->scene.solve.method;
  if (!model.static_method) {
    s.integrator = model.method.name;
    s.damping = run_->scene.damping.strategy;
  }
  s.t = run_->t;
  s.dt = run_->step;
  s.steps = run_->steps();
  s.rejected_steps = run_->rejected_steps();
  s.rhs_evaluations = run_->evaluations();
  s.phases = run_->phases;
  s.threads = thread_choice_.usual();
  if (run_->options.ranks) s.ranks = run_->options.ranks->count();
  s.wall_s = run_->wall_s();
  if (s.steps > 0)
    s.ns_per_point_step = 1e9 * run_->stepping_s / (static_cast<double>(s.steps) * static_cast<double>(s.points));
  for (const Watched& watched : watchers_) watched.watcher->fill(s, *run_);
  s.residual = s.kinetic_energy = std::numeric_limits<double>::quiet_NaN();
  if (is_readable_) fill_state(s);
  return s;
}

void Simulation::Impl::fill_state(Summary& s) {
  const LagrangianPhase& phase = *run_->model.phase;
  s.residual = run_->measured.residual();
  s.kinetic_energy = run_->measured.last().kinetic_energy;
  if (run_->scene.stop.wants_equilibrium()) refresh_distance_in_time(*run_);
  s.distance = run_->measured.distance();
  s.way_left = run_->measured.creeping.way_left;
  if (s.distance) s.distance_kind = is_bound(*run_) ? "bound" : "estimate";
  add_note(s, distance_note(verdict_.status, run_->measured.distance_to_go()));
  for (const Watched& watched : watchers_) watched.watcher->fill_state(s, *run_);
  s.error = exact_error(run_->scene, phase, run_->t, run_->motion->u());
  fill_supports(run_->scene, phase, run_->t, *run_->motion, s);
  fill_contacts(run_->scene, phase, run_->t, run_->motion->u(), s);
  if (recorder_) recorder_->fill(s, *run_);
}

}  // namespace stillpoint

// The figures of a simulation, at any moment and at its end.
#include <limits>
#include <optional>
#include <string>

#include "output/exact_error.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/left_in_points.hpp"
#include "simulation/simulation_impl.hpp"
#include "simulation/single_phase.hpp"
#include "simulation/support_figures.hpp"

namespace stillpoint {
namespace {

void add_note(Summary& s, const std::optional<std::string>& note) {
  if (note && !note->empty()) s.notes.push_back(*note);
}

}  // namespace

int Simulation::Impl::exit_status() const {
  switch (status_) {
    case RunStatus::equilibrium:
    case RunStatus::limit_load:
    case RunStatus::stop_test:
      return 0;
    case RunStatus::end_time:
      return scene_.stop.wants_equilibrium() || scene_.stop.load_growth > 0 ? 3 : 0;
    case RunStatus::diverged:
    case RunStatus::failed:
      return 4;
    default:
      return 3;
  }
}

Summary Simulation::Impl::summary() {
  Summary s;
  s.scene = scene_.name;
  s.title = scene_.title;
  s.status = status_;
  s.reason = reason_;
  s.exit_status = exit_status();
  s.notes = model_.notes;
  fill_model(s);
  fill_effort(s);
  s.plastic_overshoot = plastic_path_.overshoot();
  add_note(s, note_on_overshoot(s.plastic_overshoot));
  s.rate_share = rate_share_.share();
  add_note(s, note_on_rate_share(s.rate_share, scene_));
  s.residual = s.kinetic_energy = std::numeric_limits<double>::quiet_NaN();
  if (is_readable_) fill_state(s);
  return s;
}

void Simulation::Impl::fill_model(Summary& s) const {
  s.points = model_.phase->points();
  s.dofs = model_.phase->size();
  s.bytes_per_point = model_.phase->shape().discretisation().bytes_per_point();
  s.omega_1 = model_.omega_1;
  s.omega_max = model_.omega_max;
  s.c = model_.c ? model_.c : motion_->integrator->damping_rate();
  s.critical_step = model_.critical_step;
  s.method = scene_.solve.method;
  if (model_.static_method) return;
  s.integrator = model_.method.name;
  s.damping = scene_.damping.strategy;
}

void Simulation::Impl::fill_effort(Summary& s) const {
  s.t = t_;
  s.dt = step_;
  s.steps = steps();
  s.rejected_steps = earlier_rejected_ + motion_->integrator->rejected_steps();
  s.rhs_evaluations = evaluations();
  s.phases = phases_;
  s.threads = thread_choice_.usual();
  s.wall_s = earlier_wall_s_ + wall_.seconds();
  if (s.steps > 0)
    s.ns_per_point_step = 1e9 * stepping_s_ / (static_cast<double>(s.steps) * static_cast<double>(s.points));
}

// A frozen stiffness, and nothing that opens, closes or slides.
bool Simulation::Impl::is_bound() const {
  return !model_.phase->info().nonlinear && !model_.learns_omega_1 && !model_.phase->contact() && !creep_.way_left();
}

// What is asked of the body as it is now.
void Simulation::Impl::fill_state(Summary& s) {
  s.stability = to_string(stability_.kind);
  if (stability_.kind == EquilibriumStability::Kind::unstable) s.unstable_omega_squared = stability_.omega_squared;
  s.residual = residual();
  s.kinetic_energy = kinetic_energy_;
  if (scene_.stop.wants_equilibrium()) refresh_distance_in_time();
  s.distance = distance_beside_creep();
  s.way_left = creep_.way_left();
  if (s.distance) s.distance_kind = is_bound() ? "bound" : "estimate";
  add_note(s, distance_note(status_, distance_to_go()));
  if (const auto most = strain_in_single_phase(*model_.phase, t_, motion_->u())) s.single_phase_strain = most->strain;
  add_note(s, note_on_single_phase(s.single_phase_strain));
  if (plastic_path_.watches()) s.unbalanced_plastic_work = plastic_path_.unbalanced_work(t_, motion_->u());
  add_note(s, note_on_unbalanced_work(s.unbalanced_plastic_work, model_));
  s.error = exact_error(scene_, *model_.phase, t_, motion_->u());
  if (model_.phase->info().updated_lagrangian) {
    for (std::string& note : notes_on_late_walls(scene_, model_.phase->supports().wall_reactions(t_)))
      s.notes.push_back(std::move(note));
    const auto transfer = model_.phase->control().transfer_errors();
    s.mass_error = transfer.mass;
    s.momentum_error = transfer.momentum;
    s.angular_momentum_error = transfer.angular_momentum;
    s.added_mass = transfer.added_mass;
    s.null_space_stress = model_.phase->fields().null_space_stress(t_, motion_->u());
    add_note(s, null_space_note(scene_, *model_.phase, *s.null_space_stress));
    add_note(s, lost_motion_note(*model_.phase, t_, motion_->u(), phases_));
  }
  fill_supports(scene_, *model_.phase, t_, *motion_, s);
  if (recorder_) recorder_->fill(s, t_, *motion_);
  if (s.load) s.load->growth = limit_load_.growth();
}

}  // namespace stillpoint

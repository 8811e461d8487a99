// What a simulation looks at after its steps: whether it is at rest, at a limit, or will never be.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/stop_request.hpp"
#include "scene/longest_cell.hpp"
#include "simulation/advice/viscosity.hpp"
#include "simulation/simulation_impl.hpp"

namespace stillpoint {

void Simulation::Impl::measure() {
  if (std::exchange(measured_, true)) return;
  residual_ = motion_->residual(t_);
  if (const auto omega_1 = model_.learns_omega_1 ? motion_->integrator->lowest_frequency() : std::nullopt)
    error_bound_.learn(*omega_1);
  distance_ = error_bound_.distance(motion_->system, motion_->u_vector, motion_->integrator->acceleration());
  work_scale_ = motion_->system.work_scale(motion_->u_vector);
  const RelaxationSystem::Motion motion = motion_->motion();
  power_ = motion.power;
  kinetic_energy_ = motion.kinetic_energy;
  if (schedule_.settled_for_good(t_)) error_bound_.loads_have_settled(kinetic_energy_);
}

// A scene that asks for a distance gets that of the displacement at the end.
std::optional<double> Simulation::Impl::distance_to_go() const {
  return scene_.stop.distance > 0 ? distance_ : error_bound_.beside_largest();
}

// The distance by the stiffness that the body has now.
void Simulation::Impl::refresh_distance() {
  if (error_bound_.refresh(t_, motion_->u(), residual_)) {
    motion_->system.residual(t_, motion_->u());
    distance_ = error_bound_.distance(motion_->system, motion_->u_vector, motion_->integrator->acceleration());
  }
}

// A tangent knows nothing of what still yields on the way, nor of what slides: what is far from rest by its motion is
// no nearer, whatever the tangent says.
std::optional<double> Simulation::Impl::distance_beside_creep() const {
  const std::optional<double> way = creep_.way_left();
  if (!way || !distance_ || *way <= creep_.allowed()) return distance_;
  return std::isfinite(*way) ? std::optional(std::max(*distance_, *way)) : std::nullopt;
}

// If omega_1 is not known before, the damping that is found on the way is 2 omega_1, nearly; of a body at rest it is
// the noise of one.
void Simulation::Impl::follow_period() {
  constexpr double rest = 1e-12;  // of the largest kinetic energy so far: velocities to six digits
  if (model_.omega_1 || motion_->integrator->static_iteration()) return;
  const auto c = motion_->integrator->damping_rate();
  if (!c || !(*c > 0) || !(kinetic_energy_ > rest * monitor_.peak_kinetic_energy())) return;
  const double period = 4 * std::numbers::pi / *c;
  monitor_.set_dwell(scene_.stop.dwell * period, t_);
  creep_.set_period(period, t_);
}

void Simulation::Impl::watch() {
  const StopScope scope(asks_to_end());
  try {
    look_for_end();
  } catch (const Stopped&) {
    end_as_asked("the step was finished");
    if (leaves_checkpoints()) leave_checkpoint();
  }
}

void Simulation::Impl::look_for_end() {
  if (monitor_.due(t_) || iterate_is_balanced()) {
    measure();
    follow_period();
    monitor_.set_way_left(creep_.way_left(), creep_.allowed());
    const bool may_be_over = scene_.stop.residual <= 0 || residual_ <= scene_.stop.residual;
    if (may_be_over && distance_to_go().value_or(std::numeric_limits<double>::infinity()) <= model_.distance_goal)
      refresh_distance();
    status_ = monitor_.observe(t_, residual_, kinetic_energy_, work_scale_, loads_settled(), distance_to_go(),
                               !motion_->integrator->static_iteration());
    if (status_ == RunStatus::equilibrium && creeps()) status_ = RunStatus::running;
  }
  if (!done()) status_ = monitor_.check_limits(t_, steps());
  reason_ = status_ == RunStatus::diverged ? failure(now(), monitor_.reason()) : monitor_.reason();
  if (const std::string wrong = status_ == RunStatus::equilibrium ? schedule_.own_load_goes_on(t_) : "";
      !wrong.empty()) {
    status_ = RunStatus::failed;
    reason_ = failure(now(), "body_force.own: " + wrong);
  }
  if (!done() && options_.stop_test) {
    reason_ = options_.stop_test();
    if (!reason_.empty()) status_ = RunStatus::stop_test;
  }
  if (!done() && loads_settled()) look_for_mechanism();
  if (!done()) look_for_standstill();
  if (!done() && creep_.slides_away()) {
    status_ = RunStatus::step_limit;
    reason_ = creep_.description(t_, motion_->u());
  }
  if (!done() && scene_.load) look_for_limit_load();
}

bool Simulation::Impl::loads_settled() const {
  const Contact* const contact = model_.phase->contact();
  return schedule_.settled(t_) && (!contact || contact->is_settled());
}

bool Simulation::Impl::creeps() const { return !creep(scene_, *model_.phase).empty(); }

void Simulation::Impl::watch_plastic_path() {
  if (!options_.stops) return;
  measure();
  plastic_path_.sample(t_, motion_->system, motion_->u_vector, residual_, power_);
}

void Simulation::Impl::watch_creep() {
  if (options_.stops) creep_.sample(t_, motion_->u(), loads_settled());
}

void Simulation::Impl::look_for_mechanism() {
  // Where K is constant any u will do, and this one has been carried off.
  const ConstVec u = model_.phase->info().nonlinear ? motion_->u() : ConstVec(model_.u);
  const auto found = mechanism_.look(*model_.phase, t_, u, evaluations());
  if (!found) return;
  status_ = RunStatus::failed;
  reason_ = failure(now(), to_string(*found));
}

void Simulation::Impl::look_for_standstill() {
  if (!standstill_.lasts()) return;
  status_ = RunStatus::failed;
  reason_ = failure(now(), standstill_.description(*model_.phase, *motion_, t_));
}

// What drives the loads is the last of all supports.
void Simulation::Impl::look_for_limit_load() {
  const ConstVec reactions = motion_->system.last_reactions();
  const double force = reactions.empty() ? 0 : reactions.back();
  if (!limit_load_.observe(*model_.phase->supports().load_state(t_, motion_->u()), force) ||
      scene_.stop.load_growth <= 0)
    return;
  measure();
  const LimitLoad::Body body{.residual = residual_,
                             .kinetic_energy = kinetic_energy_,
                             .plastic_strain = giving_way_.plastic_strain(),
                             .slides = !giving_way_.shows() || !giving_way_.sliding_walls(t_).empty()};
  if (!limit_load_.reached(body)) return;
  status_ = RunStatus::limit_load;
  reason_ = "the limit load: " + limit_load_.description();
}

bool Simulation::Impl::watches_chatter() const {
  return options_.stops && scene_.stop.wants_equilibrium() && scene_.phase.ends_by_motion() && loads_settled();
}

void Simulation::Impl::watch_chatter(double share, double residual) {
  const auto said =
      chatter_.observe(*model_.phase, share * scene_.phase.max_motion, residual, longest_cell(scene_.grid));
  if (!said) return;
  status_ = RunStatus::step_limit;
  reason_ = *said;
  sample(true);
}

}  // namespace stillpoint

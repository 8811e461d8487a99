#include "simulation/simulation_impl.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "output/point_fields.hpp"
#include "output/run_folder.hpp"
#include "scene/longest_cell.hpp"
#include "simulation/multigrid_choice.hpp"
#include "simulation/viscosity.hpp"

namespace stillpoint {
namespace {

MonitorOptions monitor_options(const Scene& scene, const Model& model) {
  return {.residual = scene.stop.residual,
          .distance = model.distance_goal,
          .distance_is_asked = scene.stop.distance > 0,
          .kinetic_energy = scene.stop.kinetic_energy,
          .dwell = model.dwell,
          .must_last = model.equilibrium_must_last,
          .end_time = model.t > 0 ? 0 : scene.stop.time,  // a static solver that begins there has no time
          .steps = scene.stop.steps,
          .begin = model.t};
}

RunStatus status_of(StepReport::Status status) {
  switch (status) {
    case StepReport::Status::ok:
      return RunStatus::running;
    case StepReport::Status::failed:
      return RunStatus::failed;
    default:
      return RunStatus::diverged;
  }
}

}  // namespace

Simulation::Impl::Impl(Scene scene, SimulationOptions options, int threads)
    : scene_(std::move(scene)),
      options_(std::move(options)),
      end_request_(scene_.stop.wall_time, options_.interrupted),
      model_(set_up()),
      monitor_(monitor_options(scene_, model_)),
      error_bound_(*model_.phase, model_.omega_1, model_.volume_norm),
      schedule_(scene_, *model_.phase, scene_.stop.time),
      plastic_path_(scene_, model_),
      rate_share_(scene_, *model_.phase),
      giving_way_(scene_, *model_.phase),
      creep_(scene_, model_, giving_way_),
      standstill_(model_.integrator.max_step),
      // What Newton's method does in one step and in the next are not the same.
      thread_choice_(
          model_.static_method && model_.static_method->is_newton && options_.threads == 0 ? threads : options_.threads,
          threads),
      t_(model_.t) {
  const bool resumes = !options_.resume.empty();
  if (options_.records && !options_.out.empty()) folder_lock_ = prepare_folder(options_.out, resumes);
  if (options_.records) recorder_.emplace(scene_, model_, options_.out, has_distance(), resumes);
  if (recorder_) recorder_->tell_rows(options_.at_row);
  if (resumes) {
    resume(options_.resume);
  } else {
    begin_phase(model_.u, model_.v);
  }
}

// What a phase begins with, the first like any other: the step that follows the stiffness is asked here.
void Simulation::Impl::begin_phase(ConstVec u0, ConstVec v0) { motion_.emplace(model_, scene_, vectors_, t_, u0, v0); }

RunStatus Simulation::Impl::step(double t_stop) {
  if (done()) return status_;
  const Stopwatch watch;
  if (!std::exchange(started_, true)) {
    motion_->accept(t_);
    if (plastic_path_.due(t_)) watch_plastic_path();
    if (creep_.due(t_)) watch_creep();
    sample(true);
    if (leaves_checkpoints()) leave_checkpoint();
  }
  try {
    take_step(t_stop);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(failure(now(), "no memory is left for what a step takes"));
  }
  const double seconds = watch.seconds();
  stepping_s_ += seconds;
  thread_choice_.observe(seconds);
  if (done()) finish();
  return status_;
}

void Simulation::Impl::take_step(double t_stop) {
  const double landing = landing_time(t_stop);
  const std::optional<StepReport> taken = try_step(landing);
  if (!taken) return;
  const StepReport& report = *taken;
  t_ = report.t;
  if (report.status != StepReport::Status::ok) {
    if (report.status == StepReport::Status::inadmissible && (try_next_phase() || done())) return;
    status_ = status_of(report.status);
    reason_ = failure_of_step(scene_, *model_.phase, now(), report);
    sample(true);  // the last good state
    return;
  }
  step_ = report.h;
  standstill_.observe(step_, t_ >= landing);
  measured_ = has_residual_ = false;
  motion_->accept(t_);
  if (plastic_path_.due(t_)) watch_plastic_path();
  if (rate_share_.due(steps())) rate_share_.sample(t_, steps(), *motion_);
  if (creep_.due(t_)) watch_creep();
  if (options_.stops && !done()) watch();
  sample(done());
  report_progress();
  if (const double share = done() ? 0 : model_.phase->control().progress(t_, motion_->u()); share >= 1) {
    const double residual = watches_chatter() ? motion_->residual(t_) : 0;
    next_phase();
    if (!done() && watches_chatter()) watch_chatter(share, residual);
  }
  if (done()) return;
  const bool ends = is_to_end();
  if (leaves_checkpoints() && (checkpoint_is_due() || ends)) leave_checkpoint();
  if (ends) sample(true);
}

// Where a step has to land. Without records to land on and an end: so far away that steps are what the method takes by
// itself.
double Simulation::Impl::landing_time(double t_stop) const {
  const double horizon = 1e9 * model_.integrator.max_step;
  double landing = std::min(t_stop, std::max({horizon, 2 * t_, model_.dwell}));
  if (recorder_) landing = std::min(landing, recorder_->next_time());
  if (options_.stops && scene_.stop.time > 0) landing = std::min(landing, scene_.stop.time);
  return landing;
}

void Simulation::Impl::next_phase() {
  motion_->finish(t_);
  if (recorder_) recorder_->end_phase(t_, *motion_);
  if (plastic_path_.watches()) {
    measure();
    plastic_path_.end_phase(t_, motion_->system, motion_->u_vector);
  }
  tell_phase_change(false);
  try {
    const std::vector<double> v0 = model_.phase->control().begin_next(t_, motion_->u(), velocity_to_carry());
    follow_multigrid(scene_, model_);
    earlier_steps_ = steps();
    earlier_evaluations_ = evaluations();
    earlier_rejected_ += motion_->integrator->rejected_steps();
    model_.relaxing.from = motion_->integrator->carried_over();
    motion_.reset();
    begin_phase(std::vector<double>(v0.size(), 0.0), v0);
    std::ranges::move(model_.body_notes.later(scene_, *model_.phase), std::back_inserter(model_.notes));
    if (recorder_) recorder_->begin_phase(t_, *motion_);
    ++phases_;
    tell_phase_change(true);
  } catch (const PointLost& lost) {
    status_ = RunStatus::failed;
    reason_ = failure(now(), lost.what());
    if (const std::string slides = creep_.description(t_, motion_->u()); !slides.empty()) reason_ += "; " + slides;
  } catch (const SceneError& error) {  // no bad input: that was looked at before the run
    status_ = RunStatus::failed;
    reason_ = failure(
        now(), fmt::format("phase {} cannot begin at t = {:.6g}: {}", phases_ + 1, t_, scene_.located(error).what()));
    is_readable_ = false;
  }
}

// Of a fictitious inertia there is none: the next phase begins at rest.
ConstVec Simulation::Impl::velocity_to_carry() {
  if (!model_.multigrid) return motion_->v();
  field_.assign(model_.phase->size(), 0.0);
  return field_;
}

// A cell that is about to turn inside out is good again in the next phase.
bool Simulation::Impl::try_next_phase() {
  if (!model_.phase->info().updated_lagrangian || motion_->integrator->steps() == 0) return false;
  next_phase();
  return !done();
}

void Simulation::Impl::tell_phase_change(bool begun) const {
  if (options_.at_phase_change) options_.at_phase_change(begun);
}

// --- what a run looks at after its steps ---

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
  if (!limit_load_.observe(*model_.phase->load_state(t_, motion_->u()), force) || scene_.stop.load_growth <= 0) return;
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

// --- what it leaves behind ---

ConstVec Simulation::Impl::field(std::string_view name) {
  if (!is_readable_) throw std::logic_error("there are no fields between two phases: " + reason_);
  field_ = name == "position" ? current_positions(*model_.phase, t_, motion_->u())
                              : point_field(*model_.phase, std::string(name), t_, motion_->u(), motion_->v());
  return field_;
}

void Simulation::Impl::sample(bool last) {
  if (!recorder_) return;
  recorder_->sample(t_, *motion_, last, [&]() -> Recorder::Row {
    measure();
    return {{t_, steps(), evaluations(), residual_, kinetic_energy_}, distance_beside_creep()};
  });
}

void Simulation::Impl::report_progress() {
  constexpr double seconds_between = 0.2;
  if (!options_.progress || wall_.seconds() < next_progress_) return;
  next_progress_ = wall_.seconds() + seconds_between;
  options_.progress(
      {t_, scene_.stop.time, steps(), residual_, scene_.stop.residual, wall_.seconds(), monitor_.waits_for()});
}

}  // namespace stillpoint

#include "simulation/simulation_impl.hpp"

#include <algorithm>
#include <iterator>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "output/run_folder.hpp"

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

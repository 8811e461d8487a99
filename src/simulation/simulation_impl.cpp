// The loop: a step, what watches it, what is recorded of it, and the change of phase that it calls for.
#include "simulation/simulation_impl.hpp"

#include <algorithm>
#include <iterator>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "output/point_fields.hpp"
#include "output/run_folder.hpp"
#include "simulation/own_files.hpp"

namespace stillpoint {
namespace {

// Newton's method does not do the same in one step as in the next, so that their times cannot be compared.
bool steps_are_alike(const RunState& run) { return !(run.model.static_method && run.model.static_method->is_newton); }

}  // namespace

Simulation::Impl::Impl(Scene scene, SimulationOptions options, int threads)
    : run_(std::make_unique<RunState>(std::move(scene), std::move(options))),
      thread_choice_(run_->options.threads, threads, steps_are_alike(*run_)),
      watchers_(make_watchers(*run_)) {
  const SimulationOptions& asked = run_->options;
  const bool resumes = !asked.resume.empty();
  if (const auto folder = own_folder(asked); asked.records && !folder.empty())
    folder_lock_ = prepare_folder(folder, resumes);
  if (asked.records) recorder_.emplace(*run_, resumes);
  if (resumes) {
    resume(asked.resume);
  } else {
    run_->begin_phase(run_->model.u, run_->model.v);
  }
}

// Another simulation may take up the phase from the store. What looks at the phase goes first.
Simulation::Impl::~Impl() {
  if (!run_->options.store) return;
  recorder_.reset();
  watchers_.clear();
  run_->motion.reset();
  run_->options.store->give_back(run_->model.mass, std::move(run_->model.phase));
}

RunStatus Simulation::Impl::step(double t_stop) {
  if (done()) return verdict_.status;
  const Stopwatch watch;
  if (!std::exchange(started_, true)) {
    run_->motion->accept(run_->t);
    observe();
    record(true);
    go_on();
    if (leaves_checkpoints()) leave_checkpoint();
  }
  try {
    if (is_judging_) {
      run_->progress = run_->model.phase->control().progress(run_->t, run_->motion->u());
      end_step();
    } else {
      take_step(t_stop);
    }
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(run_->failed("no memory is left for what a step takes").reason);
  }
  const double seconds = watch.seconds();
  run_->stepping_s += seconds;
  thread_choice_.observe(seconds);
  if (done()) finish();
  return verdict_.status;
}

void Simulation::Impl::take_step(double t_stop) {
  const double landing = run_->landing = landing_time(t_stop);
  const std::optional<StepReport> report = try_step(landing);
  if (!report) return;
  run_->t = report->t;
  if (report->status != StepReport::Status::ok) return give_up(*report);
  run_->step = report->h;
  run_->is_cut = run_->t >= landing;
  run_->measured.discard();
  run_->motion->accept(run_->t);
  run_->progress = run_->model.phase->control().progress(run_->t, run_->motion->u());
  observe();
  end_step();
}

void Simulation::Impl::end_step() {
  constexpr long steps_between_looks = 100;
  if (run_->steps() % steps_between_looks == 0) run_->check_that_ranks_agree();
  if (run_->options.stops) judge();
  record(done());
  report_progress();
  if (!done()) go_on();
  if (!done() && stage_is_over()) return next_stage();
  if (!done() && run_->progress >= 1) next_phase();
  if (!done()) end_if_asked();
}

// The time that a step must not pass. Without records to land on, and without an end, it is so far away that the method
// takes the steps that it would take by itself.
double Simulation::Impl::landing_time(double t_stop) const {
  const double horizon = 1e9 * run_->model.integrator.max_step;
  double landing = std::min(t_stop, std::max({horizon, 2 * run_->t, run_->model.dwell}));
  if (recorder_) landing = std::min(landing, recorder_->next_time());
  if (!run_->scene.stages.empty() && run_->t < run_->scene.stages.front().at)
    landing = std::min(landing, run_->scene.stages.front().at);
  if (run_->options.stops && run_->scene.stop.time > 0) landing = std::min(landing, run_->scene.stop.time);
  return landing;
}

// A step of a static solver may take long: it is broken off on request, at the last equilibrium on its way. Empty: so
// it was.
std::optional<StepReport> Simulation::Impl::try_step(double landing) {
  const StopScope scope(run_->model.static_method ? run_->asks_all_to_end() : nullptr);
  try {
    return run_->motion->stepper->step(landing);
  } catch (const Stopped&) {
    end_as_asked("the step was not finished");
    run_->measured.discard();
    record(true);
    if (leaves_checkpoints()) leave_checkpoint();
    return std::nullopt;
  }
}

// A cell that is about to turn inside out is good again in the next phase. Otherwise the last good state is recorded.
void Simulation::Impl::give_up(const StepReport& report) {
  const bool may_go_on = report.status == StepReport::Status::inadmissible &&
                         run_->model.phase->info().updated_lagrangian && run_->motion->stepper->steps() > 0;
  if (may_go_on) return next_phase();
  const std::string load = load_without_value(run_->scene, *run_->model.phase, run_->t, report.h);
  verdict_ = run_->failed(load.empty() ? report.message : load + "; expected a finite number at any time");
  if (run_->model.static_method && load.empty())
    for (const Watched& watched : watchers_) watched.watcher->explain(*run_, verdict_);
  if (report.status != StepReport::Status::failed) verdict_.status = RunStatus::diverged;
  record(true);
}

void Simulation::Impl::observe() {
  for (const Watched& watched : watchers_) watched.watcher->observe(*run_);
}

void Simulation::Impl::go_on() {
  for (const Watched& watched : watchers_) watched.watcher->go_on(*run_);
}

// If a request to end breaks it off, the run that goes on from there begins with the watcher that was broken off.
void Simulation::Impl::judge() {
  const StopScope scope(run_->asks_to_end());
  is_judging_ = true;
  try {
    for (; next_to_judge_ < watchers_.size() && !done(); ++next_to_judge_) {
      verdict_ = watchers_[next_to_judge_].watcher->judge(*run_);
      if (verdict_.status == RunStatus::equilibrium && !run_->scene.stages.empty())
        stage_verdict_ = std::exchange(verdict_, {});
    }
    is_judging_ = false;
    next_to_judge_ = 0;
  } catch (const Stopped&) {
    end_as_asked("the step was finished");
    if (leaves_checkpoints()) leave_checkpoint();
  }
}

void Simulation::Impl::end_phase() {
  run_->motion->stepper->finish(run_->t);
  if (recorder_) recorder_->end_phase(*run_);
  for (const Watched& watched : watchers_) watched.watcher->end_phase(*run_, /*is_last=*/false);
  tell_phase_change(/*begun=*/false);
}

void Simulation::Impl::next_phase() {
  end_phase();
  try {
    const std::vector<double> v0 =
        run_->model.phase->control().begin_next(run_->t, run_->motion->u(), run_->velocity_to_hand_on());
    follow_multigrid(run_->scene, run_->model);
    run_->begin_next_phase(v0);
    std::ranges::move(run_->model.body_notes.later(run_->scene, *run_->model.phase),
                      std::back_inserter(run_->model.notes));
    if (recorder_) recorder_->begin_phase(*run_);
    ++run_->phases;
    tell_phase_change(/*begun=*/true);
  } catch (const PointLost& lost) {
    end_with(lost);
  } catch (const SceneError& error) {  // it is no bad input, which was looked at before the run
    end_between_phases(fmt::format("phase {}", run_->phases + 1), run_->scene.located(error).what());
  }
  let_watchers_begin();
}

void Simulation::Impl::end_with(const PointLost& lost) {
  verdict_ = run_->failed(lost.what());
  for (const Watched& watched : watchers_) watched.watcher->explain(*run_, verdict_);
}

void Simulation::Impl::end_between_phases(const std::string& next, const std::string& why) {
  verdict_ = run_->failed(fmt::format("{} cannot begin at t = {:.6g}: {}", next, run_->t, why));
  is_readable_ = false;
}

void Simulation::Impl::let_watchers_begin() {
  for (auto watched = watchers_.begin(); watched != watchers_.end() && !done(); ++watched) {
    verdict_ = watched->watcher->begin_phase(*run_);
    if (done()) record(true);
  }
}

void Simulation::Impl::report_progress() {
  constexpr double seconds_between = 0.2;
  const SimulationOptions& asked = run_->options;
  if (!asked.progress || run_->wall.seconds() < next_progress_s_) return;
  next_progress_s_ = run_->wall.seconds() + seconds_between;
  const StopSpec& stop = run_->scene.stop;
  asked.progress({run_->t, stop.time, run_->steps(), run_->measured.last().residual, stop.residual,
                  run_->wall.seconds(), run_->waits_for});
}

void Simulation::Impl::end_if_asked() {
  const bool ends = run_->options.stops && run_->end_request.asked_of_any(run_->options.ranks.get());
  if (ends) end_as_asked("the step was finished");
  if (leaves_checkpoints() && (checkpoint_is_due() || ends)) leave_checkpoint();
  if (ends) record(true);
}

void Simulation::Impl::finish() {
  // Other runs may begin with what this one leaves. A run that went wrong keeps the last state that was good, and one
  // that was asked to end has left its own.
  const bool is_over = is_own_end(verdict_.status);
  if (is_readable_) run_->check_that_ranks_agree();
  if (is_readable_ && is_over && leaves_checkpoints()) {
    leave_checkpoint();
    // Who goes on from there evaluates the state anew, from what points have committed: so does this run, for what it
    // says of its end to have the same bits.
    run_->motion->norms.residual(run_->t, run_->motion->u());
  }
  if (is_readable_) {
    run_->motion->stepper->finish(run_->t);
    for (const Watched& watched : watchers_) watched.watcher->end_phase(*run_, /*is_last=*/true);
  }
  const RunStatus reached = verdict_.status;
  const bool is_limit =
      reached == RunStatus::end_time || reached == RunStatus::step_limit || reached == RunStatus::time_limit;
  for (const Watched& watched : watchers_) {
    if (is_limit && exit_status() != 0) watched.watcher->explain(*run_, verdict_);
    if (verdict_.status == RunStatus::equilibrium) watched.watcher->confirm(*run_, verdict_);
  }
  const bool was_asked_to_end = verdict_.status != reached && verdict_.status == run_->end_request.status();
  if (was_asked_to_end && !is_over && leaves_checkpoints()) leave_checkpoint();
  if (recorder_) recorder_->finish(run_->t, is_readable_ ? &*run_->motion : nullptr);
  folder_lock_.reset();
}

ConstVec Simulation::Impl::field(std::string_view name) {
  if (!is_readable_) throw std::logic_error("there are no fields between two phases: " + verdict_.reason);
  const LagrangianPhase& phase = *run_->model.phase;
  const PhaseMotion& motion = *run_->motion;
  field_ = name == "position" ? current_positions(phase, run_->t, motion.u())
                              : point_field(phase, std::string(name), run_->t, motion.u(), motion.v());
  return field_;
}

}  // namespace stillpoint

#include <stillpoint/model.hpp>
#include <stillpoint/relaxation.hpp>
#include <stillpoint/run.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <omp.h>

#include "exact_error.hpp"
#include "history.hpp"
#include "load_schedule.hpp"
#include "stiffening_step.hpp"
#include "stopwatch.hpp"

namespace stillpoint {
namespace {

MonitorOptions monitor_options(const Scene& scene, const Model& model) {
  return {.residual = scene.stop.residual,
          .kinetic_energy = scene.stop.kinetic_energy,
          .hold = model.hold,
          .end_time = scene.stop.time,
          .steps = scene.stop.steps,
          .wall_time = scene.stop.wall_time};
}

// Time between rows: as asked; otherwise 200 rows to the end time or 20 to a period, and a whole number of steps so
// that landing on a row costs none.
double output_interval(const Scene& scene, const Model& model) {
  if (scene.output.every > 0) return scene.output.every;
  const double period = model.omega_1 ? 2 * std::numbers::pi / *model.omega_1 : model.hold;
  const double wanted = scene.stop.time > 0 ? scene.stop.time / 200 : period / 20;
  const double step = model.integrator.max_step;
  return std::max(1.0, std::round(wanted / step)) * step;
}

int exit_status_of(RunStatus status, const Scene& scene) {
  switch (status) {
    case RunStatus::equilibrium:
      return 0;
    case RunStatus::end_time:
      return scene.stop.residual > 0 ? 3 : 0;
    case RunStatus::diverged:
    case RunStatus::failed:
      return 4;
    default:
      return 3;
  }
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

// A folder that cannot be written is bad input: nothing has run yet.
History open_history(const std::filesystem::path& out, const std::vector<std::string>& columns) {
  try {
    return History(out, columns);
  } catch (const std::filesystem::filesystem_error& error) {
    const Location where{fmt::format("--out {}", out.string()), 0, 0};
    throw SceneError(std::vector<Problem>(1, {where, fmt::format("cannot be written: {}", error.code().message())}));
  }
}

/// One relaxation, from the scene's initial values to its end.
class Run {
 public:
  Run(const Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        model_(make_model(scene)),
        relaxation_(*model_.phase, *model_.damping, vectors_),
        y_(vectors_.make(2 * model_.phase->size())),
        u_(vectors_.view(first_half(y_.span()))),
        v_(vectors_.view(second_half(y_.span()))),
        integrator_(make_integrator(model_.integrator, relaxation_)),
        monitor_(monitor_options(scene, model_)),
        schedule_(scene, *model_.phase, scene.stop.residual > 0 ? scene.stop.time : 0),
        probes_(scene, *model_.phase),
        history_(open_history(options.out, probes_.columns())),
        interval_(output_interval(scene, model_)) {
    std::ranges::copy(model_.u, first_half(y_.span()).begin());
    std::ranges::copy(model_.v, second_half(y_.span()).begin());
    // A step that was asked for as such is left alone.
    if (model_.phase->nonlinear() && !scene.integrator.step) {
      stiffening_.emplace(*model_.phase, model_.u, model_.integrator.max_step);
    }
  }

  Summary relax() {
    integrator_->start(t_, y_);
    record();
    const Stopwatch stepping;
    while (status_ == RunStatus::running) {
      const double t_row = next_row_time();
      const StepReport step = integrator_->step(t_row);
      t_ = step.t;
      if (step.status != StepReport::Status::ok) {
        status_ = status_of(step.status);
        reason_ = step.message;
        record();  // the last good state
        break;
      }
      step_ = step.h;
      if (model_.phase->history_dependent()) model_.phase->commit(t_, u());
      if (stiffening_) integrator_->set_max_step(stiffening_->longest(t_, u(), v()));
      watch();
      if (t_ >= t_row || status_ != RunStatus::running) record();
      report_progress();
    }
    stepping_s_ = stepping.seconds();
    history_.finish();
    return summary();
  }

 private:
  ConstVec u() const { return first_half(y_.span()); }
  ConstVec v() const { return second_half(y_.span()); }

  // A row that rounding puts next to the end is the row at the end.
  double next_row_time() const {
    const double t_row = static_cast<double>(rows_) * interval_, end = scene_.stop.time;
    return end > 0 && t_row > end - 1e-9 * interval_ ? end : t_row;
  }

  void measure() {
    if (measured_at_ == t_) return;
    measured_at_ = t_;
    residual_ = integrator_->force_is_current() ? relaxation_.last_residual() : relaxation_.residual(t_, u());
    work_scale_ = relaxation_.work_scale(u_);
    kinetic_energy_ = relaxation_.kinetic_energy(v_);
  }

  void watch() {
    if (monitor_.due(t_)) {
      measure();
      status_ = monitor_.observe(t_, residual_, kinetic_energy_, work_scale_, schedule_.settled(t_));
    }
    if (status_ == RunStatus::running) status_ = monitor_.check_limits(t_, integrator_->steps(), wall_.seconds());
    reason_ = monitor_.reason();
    if (status_ == RunStatus::running && options_.interrupted && options_.interrupted()) {
      status_ = RunStatus::interrupted;
      reason_ = "interrupted by the user; the step was finished";
    }
  }

  void record() {
    measure();
    model_.phase->commit(t_, u());
    history_.add({t_, integrator_->steps(), relaxation_.evaluations(), residual_, kinetic_energy_},
                 probes_.read(t_, u(), v()));
    while (static_cast<double>(rows_) * interval_ <= t_) ++rows_;
  }

  void report_progress() {
    constexpr double seconds_between = 0.2;
    if (!options_.progress || wall_.seconds() < next_progress_) return;
    next_progress_ = wall_.seconds() + seconds_between;
    options_.progress({t_, scene_.stop.time, integrator_->steps(), residual_, scene_.stop.residual, wall_.seconds()});
  }

  Summary summary() {
    Summary s;
    s.scene = scene_.name;
    s.title = scene_.title;
    s.status = status_;
    s.reason = reason_;
    s.exit_status = exit_status_of(status_, scene_);
    s.t = t_;
    s.steps = integrator_->steps();
    s.rejected_steps = integrator_->rejected_steps();
    s.rhs_evaluations = relaxation_.evaluations();
    s.points = model_.phase->points();
    s.dofs = model_.phase->size();
    s.threads = omp_get_max_threads();
    s.wall_s = wall_.seconds();
    if (s.steps > 0)
      s.ns_per_point_step = 1e9 * stepping_s_ / (static_cast<double>(s.steps) * static_cast<double>(s.points));
    s.residual = residual_;
    s.kinetic_energy = kinetic_energy_;
    s.omega_1 = model_.omega_1;
    s.omega_max = model_.omega_max;
    s.c = model_.c;
    s.dt = step_;
    s.critical_step = model_.critical_step;
    s.integrator = model_.method.name;
    s.damping = model_.damping->name();
    s.notes = model_.notes;
    s.error = exact_error(scene_, *model_.phase, t_, u());
    const std::vector<double> values = probes_.read(t_, u(), v());
    std::size_t column = 0;
    for (std::size_t k = 0; k < probes_.specs().size(); ++k) {
      const ProbeSpec& probe = probes_.specs()[k];
      s.probe_places[probe.name] = probes_.place(k);
      for (const std::string& field : probe.fields) s.probes[probe.name].emplace_back(field, values[column++]);
    }
    return s;
  }

  const Scene& scene_;
  const RunOptions& options_;
  Stopwatch wall_;
  VectorSpace vectors_;
  Model model_;
  RelaxationSystem relaxation_;
  Vector y_;      // [u; v]
  Vector u_, v_;  // its halves, in place
  std::unique_ptr<Integrator> integrator_;
  Monitor monitor_;
  LoadSchedule schedule_;
  Probes probes_;
  History history_;
  double interval_;  // between rows [s]
  std::optional<StiffeningStep> stiffening_;

  double t_ = 0, step_ = 0;
  long rows_ = 0;  // number of the next row: it is due at rows_ · interval_
  double residual_ = 0, kinetic_energy_ = 0, work_scale_ = 0;
  std::optional<double> measured_at_;  // the t of both
  double stepping_s_ = 0, next_progress_ = 0;
  RunStatus status_ = RunStatus::running;
  std::string reason_;
};

}  // namespace

Summary run(const Scene& scene, const RunOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  Summary summary = Run(scene, options).relax();
  if (!options.out.empty()) {
    AtomicFile file(options.out / "summary.json");
    file.write(to_json(summary));
    file.finish();
  }
  return summary;
}

}  // namespace stillpoint

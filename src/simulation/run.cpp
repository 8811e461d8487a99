#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/run.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <omp.h>

#include "base/stopwatch.hpp"
#include "output/exact_error.hpp"
#include "output/history.hpp"
#include "output/snapshots.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/energy_balance.hpp"
#include "simulation/error_bound.hpp"
#include "simulation/load_schedule.hpp"
#include "simulation/model.hpp"
#include "simulation/motion.hpp"

namespace stillpoint {
namespace {

MonitorOptions monitor_options(const Scene& scene, const Model& model) {
  return {.residual = scene.stop.residual,
          .distance = scene.stop.distance,
          .kinetic_energy = scene.stop.kinetic_energy,
          .dwell = model.dwell,
          .end_time = scene.stop.time,
          .steps = scene.stop.steps,
          .wall_time = scene.stop.wall_time};
}

// Time between rows: as asked; otherwise 200 rows to the end time or 20 to a period, and a whole number of steps so
// that landing on a row costs none.
double output_interval(const Scene& scene, const Model& model) {
  if (scene.output.every > 0) return scene.output.every;
  const double period = model.omega_1 ? 2 * std::numbers::pi / *model.omega_1 : model.dwell;
  const double wanted = scene.stop.time > 0 ? scene.stop.time / 200 : period / 20;
  const double step = model.integrator.max_step;
  return std::max(1.0, std::round(wanted / step)) * step;
}

int exit_status_of(RunStatus status, const Scene& scene) {
  switch (status) {
    case RunStatus::equilibrium:
      return 0;
    case RunStatus::end_time:
      return scene.stop.wants_equilibrium() ? 3 : 0;
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
template <class Open>
auto open_output(const std::filesystem::path& out, const Open& open) {
  try {
    return open();
  } catch (const std::filesystem::filesystem_error& error) {
    throw_folder_error(out, error);
  }
}

/// One relaxation, from the scene's initial values to its end.
class Run {
 public:
  Run(const Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        model_(make_model(scene)),
        monitor_(monitor_options(scene, model_)),
        probes_(scene, *model_.phase),
        energy_balance_(*model_.phase),
        history_(open_output(options.out, [&] { return History(options.out, columns()); })),
        snapshots_(open_output(options.out, [&] { return Snapshots(scene, *model_.phase, options.out); })),
        error_bound_(*model_.phase, model_.omega_1),
        interval_(output_interval(scene, model_)) {
    begin_phase(model_.u, model_.v);
  }

  Summary relax() {
    motion_->accept(t_);
    record();
    snapshots_.sample(t_, u(), v());
    const Stopwatch stepping;
    while (status_ == RunStatus::running) {
      const double t_row = next_row_time();
      const StepReport step = motion_->integrator->step(std::min(t_row, next_snapshot_time()));
      t_ = step.t;
      if (step.status != StepReport::Status::ok) {
        if (step.status == StepReport::Status::inadmissible && try_next_phase()) continue;
        status_ = status_of(step.status);
        reason_ = step.message;
        record();  // the last good state
        break;
      }
      step_ = step.h;
      motion_->accept(t_);
      watch();
      if (t_ >= t_row || status_ != RunStatus::running) record();
      snapshots_.sample(t_, u(), v());
      report_progress();
      if (status_ == RunStatus::running && model_.phase->phase_progress(t_, u()) >= 1) next_phase();
    }
    stepping_s_ = stepping.seconds();
    motion_->finish(t_);
    snapshots_.finish(t_, u(), v());
    history_.finish();
    if (options_.at_end) options_.at_end(*model_.phase, t_, u(), v());
    return summary();
  }

 private:
  ConstVec u() const { return first_half(motion_->y.span()); }
  ConstVec v() const { return second_half(motion_->y.span()); }
  long steps() const { return earlier_steps_ + motion_->integrator->steps(); }
  long evaluations() const { return earlier_evaluations_ + motion_->relaxation.evaluations(); }
  long rejected_steps() const { return earlier_rejected_ + motion_->integrator->rejected_steps(); }

  std::vector<std::string> columns() const {
    std::vector<std::string> all = probes_.columns();
    std::ranges::copy(energy_balance_.columns(), std::back_inserter(all));
    if (has_distance()) all.emplace_back("distance");
    return all;
  }

  void begin_phase(ConstVec u0, ConstVec v0) {
    motion_.emplace(model_, vectors_, t_, u0, v0);
    schedule_.emplace(scene_, *model_.phase, scene_.stop.wants_equilibrium() ? scene_.stop.time : 0);
  }
  void next_phase() {
    motion_->finish(t_);
    energy_balance_.advance(t_, motion_->relaxation.last_external_force(), u());
    try {
      const std::vector<double> v0 = model_.phase->begin_next_phase(t_, u(), v());
      earlier_steps_ = steps();
      earlier_evaluations_ = evaluations();
      earlier_rejected_ = rejected_steps();
      model_.integrator.strategy.from = motion_->integrator->carried_over();
      motion_.reset();
      begin_phase(std::vector<double>(v0.size(), 0.0), v0);
      energy_balance_.begin_phase(motion_->relaxation.last_external_force());
      ++phases_;
    } catch (const PointLost& lost) {
      status_ = RunStatus::failed;
      reason_ = lost.what();
    }
  }
  // A cell that is about to turn inside out is good again in the next phase.
  bool try_next_phase() {
    if (!model_.phase->updated_lagrangian() || motion_->integrator->steps() == 0) return false;
    next_phase();
    return status_ == RunStatus::running;
  }

  // A row that rounding puts next to the end is the row at the end.
  double next_row_time() const {
    const double t_row = static_cast<double>(rows_) * interval_, end = scene_.stop.time;
    return end > 0 && t_row > end - 1e-9 * interval_ ? end : t_row;
  }

  double next_snapshot_time() const {
    const double next = snapshots_.next_time(), end = scene_.stop.time;
    return end > 0 ? std::min(next, end) : next;
  }

  void measure() {
    if (measured_at_ == t_) return;
    measured_at_ = t_;
    residual_ = motion_->residual(t_);
    distance_ = error_bound_.distance(motion_->relaxation, motion_->u_vector);
    work_scale_ = motion_->relaxation.work_scale(motion_->u_vector);
    kinetic_energy_ = motion_->relaxation.kinetic_energy(motion_->v_vector);
  }

  bool has_distance() const { return model_.omega_1 && !model_.phase->updated_lagrangian(); }
  // The distance by the stiffness that the body has now.
  void look_at_tangent() {
    if (error_bound_.refresh(t_, u(), residual_)) {
      motion_->relaxation.residual(t_, u());
      distance_ = error_bound_.distance(motion_->relaxation, motion_->u_vector);
    }
  }

  // Where omega_1 is not known before, the damping that is found on the way is 2 omega_1, nearly.
  void follow_period() {
    if (model_.omega_1 || motion_->integrator->static_iteration()) return;
    if (const auto c = motion_->integrator->damping_rate(); c && *c > 0) {
      monitor_.set_dwell(scene_.stop.dwell * 4 * std::numbers::pi / *c);
    }
  }

  void watch() {
    if (monitor_.due(t_)) {
      follow_period();
      measure();
      if (distance_ && *distance_ <= scene_.stop.distance) look_at_tangent();
      status_ = monitor_.observe(t_, residual_, kinetic_energy_, work_scale_, schedule_->settled(t_), distance_);
    }
    if (status_ == RunStatus::running) status_ = monitor_.check_limits(t_, steps(), wall_.seconds());
    reason_ = monitor_.reason();
    if (status_ == RunStatus::running && options_.interrupted && options_.interrupted()) {
      status_ = RunStatus::interrupted;
      reason_ = "interrupted by the user; the step was finished";
    }
  }

  void record() {
    measure();
    energy_balance_.advance(t_, motion_->relaxation.last_external_force(), u());
    std::vector<double> values = probes_.read(t_, u(), v());
    std::ranges::copy(energy_balance_.values(kinetic_energy_), std::back_inserter(values));
    if (has_distance()) values.push_back(distance_.value_or(std::numeric_limits<double>::quiet_NaN()));
    history_.add({t_, steps(), evaluations(), residual_, kinetic_energy_}, values);
    while (static_cast<double>(rows_) * interval_ <= t_) ++rows_;
  }

  void report_progress() {
    constexpr double seconds_between = 0.2;
    if (!options_.progress || wall_.seconds() < next_progress_) return;
    next_progress_ = wall_.seconds() + seconds_between;
    options_.progress({t_, scene_.stop.time, steps(), residual_, scene_.stop.residual, wall_.seconds()});
  }

  Summary summary() {
    Summary s;
    s.scene = scene_.name;
    s.title = scene_.title;
    s.status = status_;
    s.reason = reason_;
    s.exit_status = exit_status_of(status_, scene_);
    s.t = t_;
    s.steps = steps();
    s.rejected_steps = rejected_steps();
    s.rhs_evaluations = evaluations();
    s.phases = phases_;
    s.points = model_.phase->points();
    s.dofs = model_.phase->size();
    s.threads = omp_get_max_threads();
    s.wall_s = wall_.seconds();
    if (s.steps > 0)
      s.ns_per_point_step = 1e9 * stepping_s_ / (static_cast<double>(s.steps) * static_cast<double>(s.points));
    s.bytes_per_point = model_.phase->bytes_per_point();
    s.residual = residual_;
    if (scene_.stop.wants_equilibrium()) look_at_tangent();
    s.distance = distance_;
    s.kinetic_energy = kinetic_energy_;
    s.omega_1 = model_.omega_1;
    s.omega_max = model_.omega_max;
    s.c = model_.c ? model_.c : motion_->integrator->damping_rate();
    s.dt = step_;
    s.critical_step = model_.critical_step;
    s.integrator = model_.method.name;
    s.damping = model_.damping->name();
    s.notes = model_.notes;
    s.error = exact_error(scene_, *model_.phase, t_, u());
    if (model_.phase->updated_lagrangian()) s.transfer = model_.phase->transfer_errors();
    if (energy_balance_.watches()) s.external_work = energy_balance_.external_work();
    const std::vector<double> values = probes_.read(t_, u(), v());
    s.snapshots = snapshots_.taken();
    std::size_t column = 0;
    for (std::size_t k = 0; k < probes_.specs().size(); ++k) {
      const ProbeSpec& probe = probes_.specs()[k];
      if (!probes_.position(k).empty()) s.probe_positions[probe.name] = probes_.position(k);
    }
    for (const std::string& name : probes_.columns()) {
      const std::size_t dot = name.find('.');
      if (name.substr(dot + 1) == "slope_angle") s.slope_angle = values[column];
      s.probes[name.substr(0, dot)].emplace_back(name.substr(dot + 1), values[column++]);
    }
    return s;
  }

  const Scene& scene_;
  const RunOptions& options_;
  Stopwatch wall_;
  VectorSpace vectors_;
  Model model_;
  Monitor monitor_;
  Probes probes_;
  EnergyBalance energy_balance_;
  History history_;
  Snapshots snapshots_;
  ErrorBound error_bound_;
  double interval_;  // between rows [s]

  std::optional<Motion> motion_;  // of the present phase
  std::optional<LoadSchedule> schedule_;
  int phases_ = 1;
  long earlier_steps_ = 0, earlier_evaluations_ = 0, earlier_rejected_ = 0;  // of the phases before

  double t_ = 0, step_ = 0;
  long rows_ = 0;  // number of the next row: it is due at rows_ · interval_
  double residual_ = 0, kinetic_energy_ = 0, work_scale_ = 0;
  std::optional<double> distance_;
  std::optional<double> measured_at_;  // the t of these
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

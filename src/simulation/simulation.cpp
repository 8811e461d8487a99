#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "output/exact_error.hpp"
#include "output/point_fields.hpp"
#include "simulation/chatter.hpp"
#include "simulation/equilibrium_stability.hpp"
#include "simulation/error_bound.hpp"
#include "simulation/failure.hpp"
#include "simulation/load_schedule.hpp"
#include "simulation/mechanism.hpp"
#include "simulation/model.hpp"
#include "simulation/monitor.hpp"
#include "simulation/notes.hpp"
#include "simulation/overshoot.hpp"
#include "simulation/phase_motion.hpp"
#include "simulation/recorder.hpp"
#include "simulation/single_phase.hpp"
#include "simulation/thread_scope.hpp"

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
          .wall_time = scene.stop.wall_time};
}

double largest_cell(const Scene& scene) {
  double h = 0;
  for (std::size_t d = 0; d < scene.grid.cells.size(); ++d)
    h = std::max(h, (scene.grid.max[d] - scene.grid.min[d]) / scene.grid.cells[d]);
  return h;
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

}  // namespace

class Simulation::Impl {
 public:
  Impl(Scene scene, SimulationOptions options)
      : scene_(std::move(scene)),
        options_(std::move(options)),
        model_(make_model(scene_)),
        monitor_(monitor_options(scene_, model_)),
        error_bound_(*model_.phase, model_.omega_1),
        schedule_(scene_, *model_.phase, scene_.stop.time),
        overshoot_(scene_, model_),
        t_(model_.t) {
    if (options_.records) recorder_.emplace(scene_, model_, options_.out, has_distance());
    begin_phase(model_.u, model_.v);
  }

  RunStatus step(double t_stop) {
    if (done()) return status_;
    const Stopwatch watch;
    if (!std::exchange(started_, true)) {
      motion_->accept(t_);
      watch_overshoot();
      sample(true);
    }
    take_step(t_stop);
    stepping_s_ += watch.seconds();
    if (done()) finish();
    return status_;
  }

  bool done() const { return status_ != RunStatus::running; }

  double residual() {
    measure();
    return residual_;
  }
  std::optional<double> distance() {
    measure();
    return distance_;
  }

  ConstVec field(std::string_view name) {
    if (!is_readable_) throw std::logic_error("there are no fields between two phases: " + reason_);
    field_ = name == "position" ? current_positions(*model_.phase, t_, motion_->u())
                                : point_field(*model_.phase, std::string(name), t_, motion_->u(), motion_->v());
    return field_;
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
    s.rejected_steps = earlier_rejected_ + motion_->integrator->rejected_steps();
    s.rhs_evaluations = evaluations();
    s.phases = phases_;
    s.points = model_.phase->points();
    s.dofs = model_.phase->size();
    s.threads = omp_get_max_threads();
    s.wall_s = wall_.seconds();
    if (s.steps > 0) {
      s.ns_per_point_step = 1e9 * stepping_s_ / (static_cast<double>(s.steps) * static_cast<double>(s.points));
    }
    s.bytes_per_point = model_.phase->bytes_per_point();
    s.residual = s.kinetic_energy = std::numeric_limits<double>::quiet_NaN();
    s.stability = to_string(stability_.kind);
    if (stability_.kind == EquilibriumStability::Kind::unstable) s.unstable_omega_squared = stability_.omega_squared;
    s.omega_1 = model_.omega_1;
    s.omega_max = model_.omega_max;
    s.c = model_.c ? model_.c : motion_->integrator->damping_rate();
    s.dt = step_;
    s.critical_step = model_.critical_step;
    s.method = scene_.solve.method;
    if (!model_.static_method) {
      s.integrator = model_.method.name;
      s.damping = scene_.damping.strategy;
    }
    s.notes = model_.notes;
    s.plastic_overshoot = overshoot_.share();
    if (const std::string note = overshoot_.note(); !note.empty()) s.notes.push_back(note);
    if (!is_readable_) return s;
    s.residual = residual();
    if (scene_.stop.wants_equilibrium()) refresh_distance();
    s.distance = distance_;
    if (const auto note = distance_note(status_, distance_to_go())) s.notes.push_back(*note);
    s.kinetic_energy = kinetic_energy_;
    s.single_phase_strain = strain_in_single_phase(*model_.phase, t_, motion_->u());
    if (const std::string note = note_on_single_phase(s.single_phase_strain); !note.empty()) s.notes.push_back(note);
    s.error = exact_error(scene_, *model_.phase, t_, motion_->u());
    if (model_.phase->info().updated_lagrangian) {
      const auto transfer = model_.phase->control().transfer_errors();
      s.mass_error = transfer.mass;
      s.momentum_error = transfer.momentum;
      s.angular_momentum_error = transfer.angular_momentum;
      s.added_mass = transfer.added_mass;
      s.null_space_stress = model_.phase->null_space_stress(t_, motion_->u());
      if (const auto note = null_space_note(scene_, *model_.phase, *s.null_space_stress)) s.notes.push_back(*note);
    }
    if (recorder_) recorder_->fill(s, t_, *motion_);
    return s;
  }

  Moment now() const { return {t_, steps(), phases_}; }
  long steps() const { return earlier_steps_ + motion_->integrator->steps(); }
  long evaluations() const { return earlier_evaluations_ + motion_->system.evaluations(); }

  Scene scene_;
  SimulationOptions options_;
  Stopwatch wall_;
  VectorSpace vectors_;
  Model model_;
  Monitor monitor_;
  ErrorBound error_bound_;
  LoadSchedule schedule_;
  Chatter chatter_;
  Overshoot overshoot_;
  MechanismWatch mechanism_{scene_.stop.wants_equilibrium() && !model_.omega_1};
  std::optional<Recorder> recorder_;

  std::optional<PhaseMotion> motion_;  // of the present phase
  int phases_ = 1;
  double t_, step_ = 0;
  RunStatus status_ = RunStatus::running;
  std::string reason_;

 private:
  // What a phase begins with, the first like any other: the step that follows the stiffness is asked here.
  void begin_phase(ConstVec u0, ConstVec v0) { motion_.emplace(model_, scene_, vectors_, t_, u0, v0); }

  void take_step(double t_stop) {
    const StepReport report = motion_->integrator->step(landing_time(t_stop));
    t_ = report.t;
    if (report.status != StepReport::Status::ok) {
      if (report.status == StepReport::Status::inadmissible && try_next_phase()) return;
      status_ = status_of(report.status);
      reason_ = failure_of_step(scene_, *model_.phase, now(), report);
      sample(true);  // the last good state
      return;
    }
    step_ = report.h;
    measured_ = false;
    motion_->accept(t_);
    watch_overshoot();
    if (options_.stops) watch();
    sample(done());
    report_progress();
    if (const double share = done() ? 0 : model_.phase->control().progress(t_, motion_->u()); share >= 1) {
      const double residual = watches_chatter() ? motion_->residual(t_) : 0;
      next_phase();
      if (!done() && watches_chatter()) watch_chatter(share, residual);
    }
  }

  bool watches_chatter() const {
    return options_.stops && scene_.stop.wants_equilibrium() && scene_.phase.max_motion && schedule_.settled(t_);
  }
  void watch_chatter(double share, double residual) {
    const auto said = chatter_.observe(*model_.phase, share * *scene_.phase.max_motion, residual, largest_cell(scene_));
    if (!said) return;
    status_ = RunStatus::step_limit;
    reason_ = *said;
    sample(true);
  }

  // Where a step has to land. Without records to land on and an end: so far away that steps are what the method takes
  // by itself.
  double landing_time(double t_stop) const {
    const double horizon = 1e9 * model_.integrator.max_step;
    double landing = std::min(t_stop, std::max({horizon, 2 * t_, model_.dwell}));
    if (recorder_) landing = std::min(landing, recorder_->next_time());
    if (options_.stops && scene_.stop.time > 0) landing = std::min(landing, scene_.stop.time);
    return landing;
  }

  void next_phase() {
    motion_->finish(t_);
    if (recorder_) recorder_->end_phase(t_, *motion_);
    tell_phase_change(false);
    try {
      const std::vector<double> v0 = model_.phase->control().begin_next(t_, motion_->u(), motion_->v());
      earlier_steps_ = steps();
      earlier_evaluations_ = evaluations();
      earlier_rejected_ += motion_->integrator->rejected_steps();
      model_.relaxing.from = motion_->integrator->carried_over();
      motion_.reset();
      begin_phase(std::vector<double>(v0.size(), 0.0), v0);
      if (recorder_) recorder_->begin_phase(t_, *motion_);
      ++phases_;
      tell_phase_change(true);
    } catch (const PointLost& lost) {
      status_ = RunStatus::failed;
      reason_ = failure(now(), lost.what());
    } catch (const SceneError& error) {  // no bad input: that was looked at before the run
      status_ = RunStatus::failed;
      reason_ = failure(now(), fmt::format("phase {} cannot begin at t = {:.6g}: {}", phases_ + 1, t_, error.what()));
      is_readable_ = false;
    }
  }
  void tell_phase_change(bool begun) const {
    if (options_.at_phase_change) options_.at_phase_change(begun);
  }
  // A cell that is about to turn inside out is good again in the next phase.
  bool try_next_phase() {
    if (!model_.phase->info().updated_lagrangian || motion_->integrator->steps() == 0) return false;
    next_phase();
    return !done();
  }

  void measure() {
    if (std::exchange(measured_, true)) return;
    residual_ = motion_->residual(t_);
    distance_ = error_bound_.distance(motion_->system, motion_->u_vector);
    work_scale_ = motion_->system.work_scale(motion_->u_vector);
    power_ = motion_->system.power(motion_->v_vector);
    kinetic_energy_ = motion_->system.kinetic_energy(motion_->v_vector);
  }

  bool has_distance() const { return model_.omega_1 && !model_.phase->info().updated_lagrangian; }
  // A scene that asks for a distance gets that of the displacement at the end.
  std::optional<double> distance_to_go() const {
    return scene_.stop.distance > 0 ? distance_ : error_bound_.beside_largest();
  }
  // The distance by the stiffness that the body has now.
  void refresh_distance() {
    if (error_bound_.refresh(t_, motion_->u(), residual_)) {
      motion_->system.residual(t_, motion_->u());
      distance_ = error_bound_.distance(motion_->system, motion_->u_vector);
    }
  }

  // If omega_1 is not known before, the damping that is found on the way is 2 omega_1, nearly.
  void follow_period() {
    if (model_.omega_1 || motion_->integrator->static_iteration()) return;
    if (const auto c = motion_->integrator->damping_rate(); c && *c > 0) {
      monitor_.set_dwell(scene_.stop.dwell * 4 * std::numbers::pi / *c);
    }
  }

  void watch_overshoot() {
    if (!options_.stops || !overshoot_.due(t_)) return;
    measure();
    overshoot_.sample(t_, power_);
  }

  void look_for_mechanism() {
    const auto found = mechanism_.look(*model_.phase, t_, motion_->u(), evaluations());
    if (!found) return;
    status_ = RunStatus::failed;
    reason_ = failure(now(), to_string(*found));
  }

  void watch() {
    if (monitor_.due(t_)) {
      follow_period();
      measure();
      const bool may_be_over = scene_.stop.residual <= 0 || residual_ <= scene_.stop.residual;
      if (may_be_over && distance_to_go().value_or(std::numeric_limits<double>::infinity()) <= model_.distance_goal)
        refresh_distance();
      status_ = monitor_.observe(t_, residual_, kinetic_energy_, work_scale_, schedule_.settled(t_), distance_to_go());
    }
    if (!done()) status_ = monitor_.check_limits(t_, steps(), wall_.seconds());
    reason_ = status_ == RunStatus::diverged ? failure(now(), monitor_.reason()) : monitor_.reason();
    if (!done() && schedule_.settled(t_)) look_for_mechanism();
    if (!done() && options_.interrupted && options_.interrupted()) {
      status_ = RunStatus::interrupted;
      reason_ = "interrupted by the user; the step was finished";
    }
  }

  void sample(bool last) {
    if (!recorder_) return;
    recorder_->sample(t_, *motion_, last, [&]() -> Recorder::Row {
      measure();
      return {{t_, steps(), evaluations(), residual_, kinetic_energy_}, distance_};
    });
  }

  void report_progress() {
    constexpr double seconds_between = 0.2;
    if (!options_.progress || wall_.seconds() < next_progress_) return;
    next_progress_ = wall_.seconds() + seconds_between;
    options_.progress({t_, scene_.stop.time, steps(), residual_, scene_.stop.residual, wall_.seconds()});
  }

  // What claims to be an equilibrium may be one that the least disturbance ends.
  void test_stability() {
    const bool writes = recorder_ && !options_.out.empty();
    if (writes) remove_mode(options_.out);
    if (status_ != RunStatus::equilibrium) return;
    stability_ = stability_of(*model_.phase, t_, motion_->u(), residual_);
    if (stability_.kind == EquilibriumStability::Kind::neutral) model_.notes.push_back(description(stability_));
    if (stability_.kind != EquilibriumStability::Kind::unstable) return;
    status_ = RunStatus::unstable_equilibrium;
    reason_ = fmt::format("{}; {}", reason_, description(stability_));
    if (writes) write_mode(stability_, *model_.phase, t_, motion_->u(), options_.out);
  }

  // Limits that came before equilibrium say no more than that.
  void say_what_moves() {
    const bool is_limit =
        status_ == RunStatus::end_time || status_ == RunStatus::step_limit || status_ == RunStatus::time_limit;
    if (is_limit && exit_status_of(status_, scene_) != 0) reason_ += "; " + furthest_from_rest(*motion_, t_);
  }

  void finish() {
    if (is_readable_) motion_->finish(t_);
    if (is_readable_) say_what_moves();
    test_stability();
    if (recorder_) recorder_->finish(t_, is_readable_ ? &*motion_ : nullptr);
  }

  long earlier_steps_ = 0, earlier_evaluations_ = 0, earlier_rejected_ = 0;  // of the phases before
  bool started_ = false;
  bool is_readable_ = true;  // false if the points are between two phases, because the second could not begin
  bool measured_ = false;    // whether the next five are of now
  double residual_ = 0, kinetic_energy_ = 0, work_scale_ = 0, power_ = 0;
  std::optional<double> distance_;
  EquilibriumStability stability_;
  double stepping_s_ = 0, next_progress_ = 0;
  std::vector<double> field_;
};

Simulation::Simulation(Scene scene, SimulationOptions options) {
  const ThreadScope threads(options.threads);
  impl_ = std::make_unique<Impl>(std::move(scene), std::move(options));
}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

RunStatus Simulation::step(double t_stop) {
  const ThreadScope threads(impl_->options_.threads);
  return impl_->step(t_stop);
}

RunStatus Simulation::run_until(double t) {
  const ThreadScope threads(impl_->options_.threads);
  while (!impl_->done() && impl_->t_ < t) impl_->step(t);
  return impl_->status_;
}

bool Simulation::done() const { return impl_->done(); }
RunStatus Simulation::status() const { return impl_->status_; }
const std::string& Simulation::reason() const { return impl_->reason_; }
double Simulation::t() const { return impl_->t_; }
ConstVec Simulation::u() const { return impl_->motion_->u(); }
ConstVec Simulation::v() const { return impl_->motion_->v(); }
long Simulation::steps() const { return impl_->steps(); }
long Simulation::evaluations() const { return impl_->evaluations(); }
int Simulation::phases() const { return impl_->phases_; }
std::size_t Simulation::points() const { return impl_->model_.phase->points(); }
double Simulation::residual() { return impl_->residual(); }
ConstVec Simulation::field(std::string_view name) { return impl_->field(name); }
Summary Simulation::summary() {
  const ThreadScope threads(impl_->options_.threads);
  return impl_->summary();
}
const Model& Simulation::model() const { return impl_->model_; }
LagrangianPhase& Simulation::phase() { return *impl_->model_.phase; }
const LagrangianPhase& Simulation::phase() const { return *impl_->model_.phase; }
RelaxationSystem& Simulation::system() { return impl_->motion_->system; }
const Integrator& Simulation::integrator() const { return *impl_->motion_->integrator; }
std::optional<double> Simulation::distance() { return impl_->distance(); }
bool Simulation::loads_settled() const { return impl_->schedule_.settled(impl_->t_); }

}  // namespace stillpoint

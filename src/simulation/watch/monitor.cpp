#include "simulation/watch/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "simulation/advice/notes.hpp"

namespace stillpoint {
namespace {

MonitorOptions monitor_options(const StopSpec& stop, const Model& model) {
  return {
      .residual = stop.residual,
      .distance = model.distance_goal,
      .distance_is_asked = stop.distance > 0,
      .kinetic_energy = stop.kinetic_energy,
      .dwell = model.dwell,
      .must_last = model.equilibrium_must_last,
      .end_time = model.static_method && model.t > 0 ? 0 : stop.time,  // a static solver that begins there has no time
      .steps = stop.steps,
      .begin = model.t};
}

// An iterate is no motion, whose residual may be small for a moment only: it is looked at as soon as it may be the
// answer.
bool is_balanced_iterate(RunState& run) {
  if (run.motion->stepper->moves()) return false;
  return run.scene.stop.residual <= 0 || run.motion->known_residual(run.t) <= run.scene.stop.residual;
}

}  // namespace

Monitor::Monitor(const RunState& run, Creep& creep) : Monitor(monitor_options(run.scene.stop, run.model)) {
  creep_ = &creep;
}

Verdict Monitor::judge(RunState& run) {
  Verdict verdict;
  if (due(run.t) || is_balanced_iterate(run)) verdict = test_equilibrium(run);
  run.waits_for = run.contact_settled ? waits_for_ : "contact that does not penetrate";
  if (!verdict.ends()) verdict = {check_limits(run.t, run.steps()), reason_};
  if (verdict.status == RunStatus::equilibrium) {
    const std::string wrong = run.schedule.own_load_goes_on(run.t);
    if (!wrong.empty()) return run.failed("body_force.own: " + wrong);
  }
  if (verdict.ends() || !run.options.stop_test) return verdict;
  std::string reason = run.options.stop_test();
  return reason.empty() ? Verdict{} : Verdict{RunStatus::stop_test, std::move(reason)};
}

Verdict Monitor::test_equilibrium(RunState& run) {
  const StopSpec& stop = run.scene.stop;
  const Measurements::Figures& measured = run.measured.all();
  follow_period(run);
  set_way_left(run.measured.creeping.way_left, run.measured.creeping.allowed);
  const bool may_be_over = stop.residual <= 0 || measured.residual <= stop.residual;
  const double distance = run.measured.distance_to_go().value_or(std::numeric_limits<double>::infinity());
  if (may_be_over && distance <= run.model.distance_goal) run.measured.refresh_distance();
  const RunStatus status =
      check_balance(run.t, measured.residual, measured.kinetic_energy, measured.work_scale, run.loads_settled(),
                    run.measured.distance_to_go(), run.motion->stepper->moves());
  if (status == RunStatus::diverged) return {status, run.failed(reason_).reason};
  if (status == RunStatus::equilibrium && !creep(run.scene, *run.model.phase).empty()) return {};
  return {status, reason_};
}

// If omega_1 is not known before, the damping that is found on the way is 2 omega_1, nearly. If the body is at rest,
// that damping is noise.
void Monitor::follow_period(const RunState& run) {
  constexpr double rest = 1e-12;  // share of the largest kinetic energy so far: velocities to six digits
  if (run.model.omega_1) return;
  const auto c = run.motion->stepper->damping_rate();
  if (!c || !(*c > 0) || !(run.measured.last().kinetic_energy > rest * peak_kinetic_energy_)) return;
  const double period = 4 * std::numbers::pi / *c;
  set_dwell(run.scene.stop.dwell * period, run.t);
  creep_->set_period(period, run.t);
}

RunStatus Monitor::check_balance(double t, double residual, double kinetic_energy, double work_scale, bool settled,
                                 std::optional<double> distance, bool moves) {
  next_check_ = t + options_.dwell / checks_a_dwell;
  peak_kinetic_energy_ = std::max(peak_kinetic_energy_, kinetic_energy);
  if (!std::isfinite(residual) || !std::isfinite(kinetic_energy)) {
    reason_ =
        fmt::format("residual {:.3g} and kinetic energy {:.3g} at t = {:.6g}: not finite", residual, kinetic_energy, t);
    return RunStatus::diverged;
  }
  if (options_.residual <= 0 && options_.distance <= 0) return RunStatus::running;

  const bool near = options_.distance <= 0 || (distance ? *distance <= options_.distance : !options_.distance_is_asked);
  const bool creeps = way_left_ && !(*way_left_ <= allowed_way_);
  const bool balanced = settled && near && !creeps && (options_.residual <= 0 || residual <= options_.residual);
  constexpr double rounding = 1e-20;  // relative error of an energy, from velocities to ten digits
  const bool small = kinetic_energy <= options_.kinetic_energy * peak_kinetic_energy_;
  const bool at_rest = options_.kinetic_energy <= 0 || small || kinetic_energy <= rounding * work_scale;
  waits_for_.clear();
  if (!balanced || !at_rest) {
    balanced_since_ = -1;
    waits_for_ = missing(settled, near, distance, creeps);
    if (waits_for_.empty() && !at_rest)
      waits_for_ = fmt::format("kinetic energy {:.2g} > {:.2g} of its peak", kinetic_energy / peak_kinetic_energy_,
                               options_.kinetic_energy);
    return RunStatus::running;
  }
  if (balanced_since_ < 0) balanced_since_ = t;
  const bool must_last = options_.must_last && moves;
  if (must_last && t - balanced_since_ < options_.dwell * (1 - 1e-12)) {
    waits_for_ = fmt::format("in balance for {:.3g} of {:.3g} s", t - balanced_since_, options_.dwell);
    return RunStatus::running;
  }
  std::vector<std::string> tests;
  if (options_.residual > 0) tests.push_back(fmt::format("residual {:.3g} <= {:.3g}", residual, options_.residual));
  if (options_.distance > 0 && distance)
    tests.push_back(fmt::format("distance {:.3g} <= {:.3g}", *distance, options_.distance));
  if (way_left_)
    tests.push_back(fmt::format("way left {:.3g} <= {:.3g} of the displacement", *way_left_, allowed_way_));
  if (options_.kinetic_energy > 0 && moves) {
    if (!small) {
      tests.push_back(fmt::format("kinetic energy {:.3g} of the work, which is rounding", kinetic_energy / work_scale));
    } else if (peak_kinetic_energy_ > 0) {
      tests.push_back(fmt::format("kinetic energy {:.3g} <= {:.3g} of its peak", kinetic_energy / peak_kinetic_energy_,
                                  options_.kinetic_energy));
    } else {
      tests.emplace_back("nothing has moved");
    }
  }
  reason_ = fmt::format("{}", fmt::join(tests, " and "));
  if (must_last) reason_ += fmt::format(", held for {:.4g} s", t - balanced_since_);
  return RunStatus::equilibrium;
}

std::string Monitor::missing(bool settled, bool near, std::optional<double> distance, bool creeps) const {
  if (!settled) return "the end of the loads";
  if (!near) return distance ? fmt::format("distance {:.2g} > {:.2g}", *distance, options_.distance) : "a distance";
  if (!creeps) return "";
  return std::isfinite(*way_left_)
             ? fmt::format("way left {:.2g} > {:.2g} of the displacement", *way_left_, allowed_way_)
             : "a motion that dies out";
}

RunStatus Monitor::check_limits(double t, long steps) {
  if (options_.end_time > 0 && t >= options_.end_time) {
    reason_ = fmt::format("t = {:.6g} reached stop.time", t);
    return RunStatus::end_time;
  }
  if (options_.steps > 0 && steps >= options_.steps) {
    reason_ = fmt::format("{} steps reached stop.steps", steps);
    return RunStatus::step_limit;
  }
  return RunStatus::running;
}

void Monitor::archive(const StateArchive& state, RunState&) {
  state("dwell", options_.dwell, "next_check", next_check_, "balanced_since", balanced_since_, "peak_kinetic_energy",
        peak_kinetic_energy_);
}

}  // namespace stillpoint

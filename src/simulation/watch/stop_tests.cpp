#include "simulation/watch/stop_tests.hpp"

#include <limits>
#include <numbers>
#include <utility>

#include "simulation/advice/viscosity.hpp"

namespace stillpoint {
namespace {

MonitorOptions monitor_options(const StopSpec& stop, const Model& model) {
  return {.residual = stop.residual,
          .distance = model.distance_goal,
          .distance_is_asked = stop.distance > 0,
          .kinetic_energy = stop.kinetic_energy,
          .dwell = model.dwell,
          .must_last = model.equilibrium_must_last,
          .end_time = model.t > 0 ? 0 : stop.time,  // a static solver that begins there has no time
          .steps = stop.steps,
          .begin = model.t};
}

// An iterate is no motion, whose residual may be small for a moment only: it is looked at as soon as it may be the
// answer.
bool is_balanced_iterate(RunState& run) {
  if (!run.motion->integrator->static_iteration()) return false;
  return run.scene.stop.residual <= 0 || run.motion->known_residual(run.t) <= run.scene.stop.residual;
}

}  // namespace

StopTests::StopTests(const RunState& run, Creep& creep)
    : creep_(creep), monitor_(monitor_options(run.scene.stop, run.model)) {}

Verdict StopTests::judge(RunState& run) {
  Verdict verdict;
  if (monitor_.due(run.t) || is_balanced_iterate(run)) verdict = test_equilibrium(run);
  run.waits_for = monitor_.waits_for();
  if (!verdict.ends()) verdict = {monitor_.check_limits(run.t, run.steps()), monitor_.reason()};
  if (verdict.status == RunStatus::equilibrium) {
    const std::string wrong = run.schedule.own_load_goes_on(run.t);
    if (!wrong.empty()) return run.failed("body_force.own: " + wrong);
  }
  if (verdict.ends() || !run.options.stop_test) return verdict;
  std::string reason = run.options.stop_test();
  return reason.empty() ? Verdict{} : Verdict{RunStatus::stop_test, std::move(reason)};
}

Verdict StopTests::test_equilibrium(RunState& run) {
  const StopSpec& stop = run.scene.stop;
  const Measurements::Figures& measured = run.measured.all();
  follow_period(run);
  monitor_.set_way_left(run.measured.creeping.way_left, run.measured.creeping.allowed);
  const bool may_be_over = stop.residual <= 0 || measured.residual <= stop.residual;
  const double distance = run.measured.distance_to_go().value_or(std::numeric_limits<double>::infinity());
  if (may_be_over && distance <= run.model.distance_goal) run.measured.refresh_distance();
  const RunStatus status =
      monitor_.observe(run.t, measured.residual, measured.kinetic_energy, measured.work_scale, run.loads_settled(),
                       run.measured.distance_to_go(), !run.motion->integrator->static_iteration());
  if (status == RunStatus::diverged) return {status, run.failed(monitor_.reason()).reason};
  if (status == RunStatus::equilibrium && !creep(run.scene, *run.model.phase).empty()) return {};
  return {status, monitor_.reason()};
}

// If omega_1 is not known before, the damping that is found on the way is 2 omega_1, nearly. If the body is at rest,
// that damping is noise.
void StopTests::follow_period(const RunState& run) {
  constexpr double rest = 1e-12;  // share of the largest kinetic energy so far: velocities to six digits
  const Integrator& integrator = *run.motion->integrator;
  if (run.model.omega_1 || integrator.static_iteration()) return;
  const auto c = integrator.damping_rate();
  if (!c || !(*c > 0) || !(run.measured.last().kinetic_energy > rest * monitor_.peak_kinetic_energy())) return;
  const double period = 4 * std::numbers::pi / *c;
  monitor_.set_dwell(run.scene.stop.dwell * period, run.t);
  creep_.set_period(period, run.t);
}

}  // namespace stillpoint

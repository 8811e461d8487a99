#include <stillpoint/spectrum.hpp>
#include <stillpoint/stability.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "linalg/sparse_cholesky.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/loads/load_schedule.hpp"
#include "simulation/setup/balanced_leapfrog.hpp"
#include "simulation/setup/set_up_state.hpp"
#include "simulation/setup/stiffening_step.hpp"
#include "solvers/spectrum/local_damping_gain.hpp"

namespace stillpoint {
namespace {

// The expected size of the motion, so that tolerances need no number from the user: the largest displacement of a
// material point under the loads of any time, u = K⁻¹ Q(t), or under the initial values.
double displacement_scale(const SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  const Model& model = set_up.model;
  const LagrangianPhase& phase = *model.phase;
  const double begin = set_up.begin.t;
  double scale = 0;
  std::vector<double> at_points(phase.points() * static_cast<std::size_t>(phase.dim()));
  const auto widen = [&](double factor) {
    for (const double u : at_points) scale = std::max(scale, factor * std::abs(u));
  };
  phase.fields().point_displacement(begin, model.u, at_points);
  widen(1);
  phase.fields().point_velocity(begin, model.v, at_points);
  widen(1 / *model.omega_1);

  const SparseCholesky K(phase.tangents().matrix(Tangent::elastic, begin, model.u));
  const double span = problem.stop.time > 0 ? problem.stop.time - begin : 2 * std::numbers::pi / *model.omega_1;
  const int samples = loads_vary(problem) ? 32 : 0;
  for (int k = 0; k <= samples; ++k) {
    const double t = begin + (samples > 0 ? span * k / samples : 0);
    std::vector<double> u = total_load_at(phase, t);
    K.solve(u, u);
    phase.fields().point_displacement(t, u, at_points);
    widen(1);
  }
  return scale;
}

void set_tolerances(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  const IntegratorSpec& spec = problem.integrator;
  model.integrator.rtol = spec.rtol;
  if (!spec.rtol) return;
  if (!spec.atol_u || !spec.atol_v) {
    const auto measured = [&] { return displacement_scale(set_up); };
    const double scale = model.omega_1 ? parts.shared("size of the motion", model.mass, measured) : 0;
    if (!(scale > 0)) {
      throw_scene_error(
          "integrator.rtol",
          "the size of the motion is not known beforehand; expected integrator.atol_u and integrator.atol_v beside "
          "rtol");
    }
    model.integrator.atol_u = *spec.rtol * scale;
    model.integrator.atol_v = *spec.rtol * scale * *model.omega_1;
  }
  if (spec.atol_u) model.integrator.atol_u = *spec.atol_u;
  if (spec.atol_v) model.integrator.atol_v = *spec.atol_v;
}

// A relaxation that takes the spectrum to its end must stay below the critical step all the time: if that moves,
// StiffeningStep follows in notches of 1.1.
double step_fraction(const SetUpState& set_up) {
  const RelaxationInfo* relaxation = set_up.plan.relaxation;
  if (!relaxation || !(relaxation->step_fraction > 0)) return set_up.problem.integrator.step_fraction;
  const bool follows = relaxation->needs_upper_end && set_up.model.phase->info().stiffens;
  return follows ? relaxation->step_fraction / StiffeningStep::notch : relaxation->step_fraction;
}

// Leapfrog is balanced, see balanced_leapfrog.hpp, if a narrow spectrum allows it and no key asks for another damping.
bool is_balanced_leapfrog(const SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  const Plan& plan = set_up.plan;
  const Model& model = set_up.model;
  const DampingTreatment treatment = problem.integrator.treatment;
  return plan.multigrid && model.omega_1 && model.c && !problem.damping.c && model.method.hosts_relaxations &&
         (treatment == DampingTreatment::automatic || treatment == DampingTreatment::averaged);
}

void choose_step(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Model& model = set_up.model;
  const IntegratorSpec& spec = problem.integrator;
  const bool adaptive = spec.rtol.has_value();
  if (model.method.amplification) {
    const double gain = local_damping_gain(*model.phase, set_up.begin.t, model.u, *model.damping, model.omega_max);
    const DampedSpectrum spectrum =
        damped_spectrum(model.omega_1.value_or(0), gain * model.omega_max, *model.damping, model.phase->mass());
    constexpr double most_radians = 1e3;  // h omega_max of a step whose method has no limit of its own
    model.critical_step =
        std::min(critical_step(model.method, *model.damping, spectrum), most_radians / model.omega_max);
  }
  if (spec.step) {
    model.integrator.max_step = *spec.step;
    // Past its stability limit an adaptive step stalls near equilibrium, where it excites what it should damp.
    if (adaptive && model.critical_step && *model.critical_step > 0 && spec.unstable_reason.empty()) {
      model.integrator.max_step = std::min(*spec.step, spec.step_fraction * *model.critical_step);
    }
    if (!adaptive && model.critical_step && *spec.step > *model.critical_step * (1 + 1e-9) &&
        spec.unstable_reason.empty()) {
      throw_scene_error(
          "integrator.step",
          fmt::format("the step {:.6g} is past the critical one of {} here, {:.6g}; expected a smaller step, "
                      "integrator.step_fraction, or integrator.unstable_reason to say why",
                      *spec.step, model.method.name, *model.critical_step));
    }
  } else if (model.critical_step && *model.critical_step > 0) {
    model.integrator.max_step = step_fraction(set_up) * *model.critical_step;
    if (is_balanced_leapfrog(set_up))
      model.integrator.max_step = std::min(model.integrator.max_step, balanced_step(*model.omega_1, model.omega_max));
  } else if (adaptive) {
    model.integrator.max_step = 1 / model.omega_max;  // no limit of its own: the error control is what bounds the step
  } else {
    throw_scene_error(
        "integrator.method",
        fmt::format("{} has no stable step on this scene; expected another method, damping, or integrator.step with "
                    "integrator.unstable_reason",
                    model.method.name));
  }
}

// Sets the damping, and what the integrator or the relaxation that steps it is made of.
void choose_strategy(SetUpState& set_up, bool takes_c) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  Model& model = set_up.model;
  if (takes_c) model.c = problem.damping.c ? *problem.damping.c : 2 * *model.omega_1;
  if (is_balanced_leapfrog(set_up)) {
    const double longest = problem.integrator.step_fraction * 2 / model.omega_max;
    const double usual = std::min(longest, balanced_step(*model.omega_1, model.omega_max));
    model.c = balanced_damping(*model.omega_1, problem.integrator.step.value_or(usual));
  }
  model.damping = plan.relaxation || plan.static_method
                      ? no_damping()
                      : make_damping(problem.damping.strategy, model.c.value_or(0), problem.damping.alpha);
  const bool hosted = plan.relaxation && model.method.hosts_relaxations;
  model.integrator.method = problem.integrator.method;
  model.integrator.treatment = problem.integrator.treatment;
  model.integrator.halts_at_energy_peaks = plan.relaxation && !hosted && plan.relaxation->is_event_of_erk;
  model.relaxing = {.name = problem.damping.strategy,
                    .peak = problem.damping.peak,
                    .quotient = problem.damping.quotient,
                    .omega_1 = model.omega_1.value_or(0),
                    .steady = plan.equilibrium_only,
                    .single_phase = !plan.moves_on,
                    .path_dependent = plan.remembers,
                    .linear = plan.estimates.linear};
}

}  // namespace

void choose_damping_and_step(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  Model& model = set_up.model;
  const bool takes_c = !plan.static_method && plan.strategy->uses("c");
  choose_strategy(set_up, takes_c);
  if (!plan.static_method) set_tolerances(set_up);
  choose_step(set_up);
  if (takes_c && model.omega_1) {
    const double c = model.damping->linear().mass;
    if (const auto slow = slow_damping_note(problem, c, *model.omega_1, model.integrator.max_step)) set_up.note(*slow);
  }
  model.relaxing.max_step = model.integrator.max_step;
}

}  // namespace stillpoint

#include "simulation/model.hpp"

#include <stillpoint/spectrum.hpp>
#include <stillpoint/stability.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "output/probes.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/highest_frequency.hpp"
#include "simulation/load_notes.hpp"
#include "simulation/load_schedule.hpp"
#include "simulation/mechanism.hpp"
#include "simulation/notes.hpp"
#include "simulation/omega_1_needs.hpp"
#include "simulation/stiffening_step.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"
#include "solvers/spectrum/local_damping_gain.hpp"

namespace stillpoint {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// Whether R can be evaluated where the motion begins.
void check_initial_state(const Scene& scene, const LagrangianPhase& phase, ConstVec u) {
  std::vector<double> R(phase.size());
  const auto trial = phase.make_trial();
  if (phase.internal_force(0, u, R, *trial)) return;
  throw_scene_error(scene, "initial", "the initial state cannot be evaluated: " + phase.diagnosis().refusal(*trial));
}

// The size of the motion to expect, so that tolerances need no number from the user: the largest displacement of a
// material point under the loads of any time, u = K⁻¹ Q(t), or under the initial values.
double displacement_scale(const Scene& scene, const Model& model) {
  const LagrangianPhase& phase = *model.phase;
  double scale = 0;
  std::vector<double> at_points(phase.points() * static_cast<std::size_t>(phase.dim()));
  const auto widen = [&](double factor) {
    for (const double u : at_points) scale = std::max(scale, factor * std::abs(u));
  };
  phase.point_displacement(0, model.u, at_points);
  widen(1);
  phase.point_velocity(0, model.v, at_points);
  widen(1 / *model.omega_1);

  const SparseCholesky K(phase.tangents().matrix(Tangent::elastic, 0, model.u));
  const double span = scene.stop.time > 0 ? scene.stop.time : two_pi / *model.omega_1;
  const int samples = loads_vary(scene) ? 32 : 0;
  for (int k = 0; k <= samples; ++k) {
    const double t = samples > 0 ? span * k / samples : 0;
    std::vector<double> u = total_load_at(phase, t);
    K.solve(u, u);
    phase.point_displacement(t, u, at_points);
    widen(1);
  }
  return scale;
}

void set_tolerances(const Scene& scene, SetUp& set_up, Model& model) {
  const IntegratorSpec& spec = scene.integrator;
  model.integrator.rtol = spec.rtol;
  if (!spec.rtol) return;
  if (!spec.atol_u || !spec.atol_v) {
    const auto measured = [&] { return displacement_scale(scene, model); };
    const double scale = model.omega_1 ? set_up.shared("size of the motion", model.mass, measured) : 0;
    if (!(scale > 0)) {
      throw_scene_error(
          scene, "integrator.rtol",
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
double step_fraction(const Scene& scene, const Model& model) {
  const RelaxationInfo* relaxation = model.relaxation;
  if (!relaxation || !(relaxation->step_fraction > 0)) return scene.integrator.step_fraction;
  const bool follows = relaxation->needs_upper_end && model.phase->info().stiffens;
  return follows ? relaxation->step_fraction / StiffeningStep::notch : relaxation->step_fraction;
}

// Leapfrog's step h takes M⁻¹K's ω² to 1 − h²ω²/2 = cos θ, a motion of the angle θ a step. Where κ is small the usual
// large step damps the highest modes less than the lowest: with
//
//   h² = 4/(ω₁² + ω_max²),   c = 2 ω₁ √(1 − h²ω₁²/4)
//
// both ends are critical, and all modes go by (√κ − 1)/(√κ + 1) a step, as by Polyak's heavy ball [1964]; for a large κ
// that c is 2 ω₁.
bool is_critical_leapfrog(const Scene& scene, const Model& model) {
  const DampingTreatment treatment = scene.integrator.treatment;
  return model.multigrid && model.omega_1 && model.c && !scene.damping.c && model.method.hosts_relaxations &&
         (treatment == DampingTreatment::automatic || treatment == DampingTreatment::averaged);
}
double balanced_step(const Model& model) { return 2 / std::hypot(*model.omega_1, model.omega_max); }
double balanced_damping(double omega_1, double h) {
  return 2 * omega_1 * std::sqrt(std::max(0.0, 1 - h * h * omega_1 * omega_1 / 4));
}

void choose_step(const Scene& scene, Model& model) {
  const IntegratorSpec& spec = scene.integrator;
  const bool adaptive = spec.rtol.has_value();
  if (model.method.amplification) {
    const double gain = local_damping_gain(*model.phase, 0, model.u, *model.damping, model.omega_max);
    const DampedSpectrum spectrum =
        damped_spectrum(model.omega_1.value_or(0), gain * model.omega_max, *model.damping, model.phase->mass());
    constexpr double longest = 1e3;  // of 1/omega_max: a step is never without a limit, though the method may have none
    model.critical_step = std::min(critical_step(model.method, *model.damping, spectrum), longest / model.omega_max);
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
          scene, "integrator.step",
          fmt::format("the step {:.6g} is past the critical one of {} here, {:.6g}; expected a smaller step, "
                      "integrator.step_fraction, or integrator.unstable_reason to say why",
                      *spec.step, model.method.name, *model.critical_step));
    }
  } else if (model.critical_step && *model.critical_step > 0) {
    model.integrator.max_step = step_fraction(scene, model) * *model.critical_step;
    if (is_critical_leapfrog(scene, model))
      model.integrator.max_step = std::min(model.integrator.max_step, balanced_step(model));
  } else if (adaptive) {
    model.integrator.max_step = 1 / model.omega_max;  // no limit of its own: the error control is what bounds the step
  } else {
    throw_scene_error(
        scene, "integrator.method",
        fmt::format("{} has no stable step on this scene; expected another method, damping, or integrator.step with "
                    "integrator.unstable_reason",
                    model.method.name));
  }
}

// ω₁ by Lanczos' method on K⁻¹M. Throws if something cannot do without; a note if equilibrium can.
void find_omega_1(const Scene& scene, const Omega1Needs& needs, SetUp& set_up, Model& model) {
  const FrequencyEstimate lowest =
      set_up.shared(part_omega_1, model.mass, [&] { return omega_1_by_lanczos(*model.phase, 0, model.u); });
  if (lowest.converged) {
    model.omega_1 = lowest.omega;
    const bool physical_mass = !(model.relaxation && model.relaxation->chooses_mass);
    if (physical_mass && scene.mass.scaling == MassScaling::uniform)
      std::ranges::move(lowest_mode_notes(scene, *model.phase, lowest.mode, lowest.omega),
                        std::back_inserter(model.notes));
    return;
  }
  refuse_mechanism(scene, *model.phase, model.u);
  if (needs.distance) {
    throw_scene_error(
        scene, "stop.distance",
        fmt::format("a distance is bounded by omega_1, but {}; expected a support, or stop.residual", lowest.status));
  }
  if (needs.relaxation) {
    throw_scene_error(
        scene, "damping.strategy",
        fmt::format("'{}' needs omega_1, but {}; expected a support, more points per cell, or another strategy",
                    model.relaxation->about.name, lowest.status));
  }
  if (needs.critical_damping) {
    throw_scene_error(
        scene, "damping.c",
        fmt::format("critical damping needs omega_1, but {}; expected a support, more points per cell, or a number",
                    lowest.status));
  }
  model.notes.push_back(
      fmt::format("omega_1 is not known ({}): equilibrium is held for 100 of the shortest periods", lowest.status));
}

// How long equilibrium has to last: a body that is not held has no lowest frequency, and a hundred of its shortest
// periods stand in for the longest. A static solver has no motion that may only be turning round.
double dwell_of(const Scene& scene, const Model& model) {
  if (model.static_method) return 0;
  return scene.stop.dwell * (model.omega_1 ? two_pi / *model.omega_1 : 100 * two_pi / model.omega_max);
}

// The error bound that equilibrium takes: what the scene asks for; beside its residual one by default, which a residual
// that is small only beside the stiffest part's forces does not pass.
double distance_goal_of(const Scene& scene, const Model& model) {
  constexpr double usual = 1e-3;
  const bool is_known = (model.omega_1 && !model.phase->info().updated_lagrangian) || model.learns_omega_1;
  const bool by_default = scene.stop.residual > 0 && is_known && !scene.where.contains("stop.distance");
  return by_default ? usual : scene.stop.distance;
}

// Whether ‖u − u*‖ ≤ ‖M⁻¹Q‖/ω₁² holds at every moment, as in a linear body under steady loads: with the kinetic energy
// small as well, no later moment can be further off.
bool residual_bounds_error(const Scene& scene, const Model& model) {
  const PhaseInfo& info = model.phase->info();
  return model.omega_1 && !info.nonlinear && !info.updated_lagrangian && !loads_vary(scene) && !model.phase->contact();
}

// Whether Q = F − R is linear in u, and symmetric.
bool is_linear(const LagrangianPhase& phase, ConstVec u) {
  return !phase.info().nonlinear && phase.tangents().of_loads(0, u).nonZeros() == 0;
}

// How the way to rest is gone: the damping and what steps it.
void choose_strategy(const Scene& scene, bool takes_c, Model& model) {
  if (takes_c) model.c = scene.damping.c ? *scene.damping.c : 2 * *model.omega_1;
  if (is_critical_leapfrog(scene, model)) {
    const double longest = scene.integrator.step_fraction * 2 / model.omega_max;
    model.c = balanced_damping(*model.omega_1, scene.integrator.step.value_or(std::min(longest, balanced_step(model))));
  }
  model.damping = model.relaxation || model.static_method
                      ? no_damping()
                      : make_damping(scene.damping.strategy, model.c.value_or(0), scene.damping.alpha);
  const bool hosted = model.relaxation && model.method.hosts_relaxations;
  model.integrator.method = scene.integrator.method;
  model.integrator.treatment = scene.integrator.treatment;
  model.integrator.halts_at_energy_peaks = model.relaxation && !hosted && model.relaxation->is_event_of_erk;
  model.relaxing = {.name = scene.damping.strategy,
                    .peak = scene.damping.peak,
                    .quotient = scene.damping.quotient,
                    .omega_1 = model.omega_1.value_or(0),
                    .steady = wants_equilibrium_only(scene),
                    .single_phase = !model.phase->info().updated_lagrangian,
                    .linear = is_linear(*model.phase, model.u)};
}

// Whether conjugate directions lead to rest with any mass.
bool may_take_multigrid(const LagrangianPhase& phase) {
  return !phase.info().updated_lagrangian && !phase.contact() && is_linear(phase, phase.initial_displacement(0));
}

void take_multigrid(const Scene& scene, bool is_auto, SetUp& set_up, Model& model) {
  const bool by_motion = !model.static_method && !is_auto;
  if (by_motion || is_auto) {
    const char* const what = model.phase->info().history_names.empty() ? "a nonlinear body" : "points that remember";
    if (!is_linear(*model.phase, model.u)) {
      throw_scene_error(scene, "mass.kind",
                        fmt::format("'multigrid' keeps to the stiffness of the start, which leads {} nowhere; take "
                                    "solve.method = \"newton-cg\" with it",
                                    what));
    }
  }
  model.multigrid = set_up.shared(by_motion ? "multigrid" : "multigrid without omega_1", scene.mass,
                                  [&] { return make_multigrid_mass(scene, *model.phase, model.u, !by_motion); });
  model.omega_max = model.multigrid->omega_max;
  if (by_motion) model.omega_1 = model.multigrid->omega_1;
  model.notes.push_back(
      "with mass.kind = \"multigrid\" frequencies and velocities are those of a fictitious inertia, and the distance "
      "is that of the strain energy, ‖u − u*‖_K/‖u‖_K");
}

// begin(what) is told of each part before it is made.
template <class Begin>
Model make_parts(const Scene& scene, SetUpStore* store, const Begin& begin) {
  Model model;
  SetUp set_up(store);
  const StrategyInfo& strategy = *catalogue().strategy(scene.damping.strategy);
  model.static_method = catalogue().static_method(scene.solve.method);
  if (!model.static_method) model.relaxation = find_relaxation(strategy.name);
  const bool takes_c = !model.static_method && strategy.uses("c");
  model.method = find_method(scene.integrator.method, scene.integrator.treatment);
  begin("the material points, their weights and the mass");
  model.phase = set_up.phase(scene);
  model.mass = scene.mass;
  begin("the choice of a mass");
  const bool is_multigrid = scene.mass.kind == MassKind::multigrid;
  const bool is_auto = model.relaxation && model.relaxation->chooses_mass;
  const bool pays = is_auto && !is_multigrid && may_take_multigrid(*model.phase) &&
                    multigrid_pays(scene, static_cast<double>(model.phase->size()));
  if (pays) {
    model.notes.push_back(
        fmt::format("auto takes mass.kind = \"multigrid\", which is quicker than a lumped mass with {} unknowns",
                    model.phase->size()));
  }
  const bool chooses_mass = is_auto && !is_multigrid && !pays;
  const bool scaled = chooses_mass && choose_mass(scene, model, set_up, store);
  std::ranges::move(accuracy_notes(scene, *model.phase, scaled), std::back_inserter(model.notes));
  begin("the initial state");
  model.u = model.phase->initial_displacement(0);
  model.v = model.phase->initial_velocity(0);
  check_probes(scene, *model.phase);
  check_initial_state(scene, *model.phase, model.u);
  std::ranges::move(load_notes(scene, *model.phase, model.u), std::back_inserter(model.notes));
  if (is_multigrid || pays) {
    begin("the hierarchy of multigrid");
    take_multigrid(scene, is_auto, set_up, model);
  }
  begin("the highest frequency");
  if (!chooses_mass && !model.multigrid) {
    model.omega_max =
        set_up.shared("omega_max", model.mass, [&] { return highest_frequency(scene, *model.phase, model.u); });
  }
  const Omega1Needs needs = omega_1_needs(scene, model.phase->size());
  begin("the lowest frequency, with a factor of the stiffness");
  if (needs.any() && !model.multigrid) find_omega_1(scene, needs, set_up, model);
  begin("the norm of errors");
  const bool has_scaled_mass = scaled || scene.mass.scaling != MassScaling::uniform;
  model.learns_omega_1 = !model.omega_1 && is_auto && wants_equilibrium_only(scene) &&
                         (model.multigrid || mass_measures_volume(scene, has_scaled_mass)) &&
                         !model.phase->info().updated_lagrangian && is_linear(*model.phase, model.u);
  if (model.omega_1 && !model.multigrid && scene.stop.wants_equilibrium() && !model.phase->info().updated_lagrangian) {
    model.volume_norm =
        set_up.shared("norm", model.mass, [&] { return volume_norm(scene, *model.phase, has_scaled_mass, model.u); });
  }
  if (scene.stop.wants_equilibrium() && scene.stop.time == 0 && loads_vary(scene)) {
    model.notes.push_back(
        "loads or supports depend on t and stop.time is not set: a plateau that outlasts stop.hold counts as "
        "equilibrium");
  }
  if (model.static_method && model.static_method->takes_end_of_loads) model.t = scene.stop.time;
  begin("the damping and the step");
  model.dwell = dwell_of(scene, model);
  model.distance_goal = distance_goal_of(scene, model);
  model.equilibrium_must_last = !model.static_method && !residual_bounds_error(scene, model);
  choose_strategy(scene, takes_c, model);
  if (!model.static_method) set_tolerances(scene, set_up, model);
  choose_step(scene, model);
  if (takes_c && model.omega_1) {
    const double c = model.damping->linear().mass;
    if (const auto note = slow_damping_note(scene, c, *model.omega_1, model.integrator.max_step))
      model.notes.push_back(*note);
  }
  model.relaxing.max_step = model.integrator.max_step;
  if (model.phase->info().stiffens && !scene.integrator.step) {
    model.initial_stiffening = model.phase->stiffening(0, model.u);
  }
  model.parts = set_up.parts();
  model.spared_s = set_up.spared_s();
  return model;
}

}  // namespace

Model make_model(const Scene& scene, SetUpStore* store) {
  const char* part = "";
  try {
    return make_parts(scene, store, [&](const char* what) {
      heed_stop_request();
      part = what;
    });
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("no memory is left in the set-up for {}; expected fewer cells or points", part));
  }
}

}  // namespace stillpoint

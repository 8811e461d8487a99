#include "simulation/model.hpp"

#include <algorithm>
#include <iterator>
#include <new>
#include <numbers>
#include <stdexcept>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "output/probes.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/damping_and_step.hpp"
#include "simulation/highest_frequency.hpp"
#include "simulation/load_notes.hpp"
#include "simulation/load_schedule.hpp"
#include "simulation/lowest_frequency.hpp"
#include "simulation/multigrid_choice.hpp"
#include "simulation/notes.hpp"
#include "simulation/scene_motion.hpp"
#include "simulation/viscosity.hpp"

namespace stillpoint {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// Whether R can be evaluated where the motion begins.
void check_initial_state(const LagrangianPhase& phase, ConstVec u) {
  std::vector<double> R(phase.size());
  const auto trial = phase.make_trial();
  if (phase.internal_force(0, u, R, *trial)) return;
  throw_scene_error("initial", "the initial state cannot be evaluated: " + phase.diagnosis().refusal(*trial));
}

// How long equilibrium has to last: a body that is not held has no lowest frequency, and a hundred of its shortest
// periods stand in for the longest; with multigrid, where all are nearly alike, five. A static solver has no motion
// that may only be turning round.
double dwell_of(const Problem& problem, const Model& model) {
  if (model.static_method) return 0;
  const double short_ones = model.multigrid ? 5 : 100;
  return problem.stop.dwell * (model.omega_1 ? two_pi / *model.omega_1 : short_ones * two_pi / model.omega_max);
}

// The error bound that equilibrium takes: what the scene asks for; beside its residual one by default, which a residual
// that is small only beside the stiffest part's forces does not pass.
double distance_goal_of(const Problem& problem, const Model& model) {
  constexpr double usual = 1e-3;
  const bool is_known = (model.omega_1 && !model.phase->info().updated_lagrangian) || model.learns_omega_1;
  const bool by_default = problem.stop.residual > 0 && is_known && !problem.stop.distance.is_asked();
  return by_default ? usual : problem.stop.distance.value();
}

// Whether ‖u − u*‖ ≤ ‖M⁻¹Q‖/ω₁² holds at every moment, as in a linear body under steady loads: with the kinetic energy
// small as well, no later moment can be further off.
bool residual_bounds_error(const Problem& problem, const Model& model) {
  const PhaseInfo& info = model.phase->info();
  return model.omega_1 && !info.nonlinear && !info.updated_lagrangian && !loads_vary(problem) &&
         !model.phase->contact();
}

// Whether Q = F − R is linear in u, and symmetric.
bool is_linear(const LagrangianPhase& phase, ConstVec u) {
  return !phase.info().nonlinear && phase.tangents().of_loads(0, u).nonZeros() == 0;
}

// begin(what) is told of each part before it is made.
template <class Begin>
Model make_parts(const Problem& problem, SetUpStore* store, const Begin& begin) {
  Model model;
  SetUp set_up(store);
  model.static_method = catalogue().static_method(problem.solve.method);
  if (!model.static_method) model.relaxation = find_relaxation(problem.damping.strategy);
  model.method = find_method(problem.integrator.method, problem.integrator.treatment);
  begin("the material points, their weights and the mass");
  model.phase = set_up.phase(problem);
  model.mass = problem.mass;
  begin("the initial state");
  model.u = model.phase->initial_displacement(0);
  check_probes(problem, *model.phase);
  check_initial_state(*model.phase, model.u);
  model.linear = is_linear(*model.phase, model.u);
  begin("the choice of a mass, and the hierarchy of multigrid");
  choose_multigrid(problem, set_up, model);
  const bool tries_another_mass = chooses_mass(problem) && !model.multigrid;
  const bool scaled = tries_another_mass && choose_mass(problem, model, set_up, store);
  std::ranges::move(model.body_notes.at_start(problem, *model.phase), std::back_inserter(model.notes));
  std::ranges::move(accuracy_notes(problem, *model.phase, scaled), std::back_inserter(model.notes));
  std::ranges::move(load_notes(problem, *model.phase, model.u), std::back_inserter(model.notes));
  model.v = model.phase->initial_velocity(0);
  begin("the highest frequency");
  if (!tries_another_mass && !model.multigrid) {
    model.omega_max = set_up.shared("omega_max", model.mass, [&] { return highest_frequency(*model.phase, model.u); });
  }
  const bool has_scaled_mass = scaled || problem.mass.scaling != MassScaling::uniform;
  const bool steps_tell = steps_tell_omega_1(
      problem, {.linear = model.linear,
                .moves_on = model.phase->info().updated_lagrangian,
                .mass_measures_volume = model.multigrid || mass_measures_volume(problem, has_scaled_mass)});
  const Omega1Needs needs = omega_1_needs(problem, model.phase->size(), steps_tell);
  begin("the lowest frequency, with a factor of the stiffness");
  if (needs.any() && !model.multigrid) find_omega_1(problem, needs, set_up, model);
  const bool goes_without_bound = !needs.any() && !model.multigrid && !steps_tell && !chooses_mass(problem);
  if (goes_without_bound && problem.stop.wants_equilibrium() && !model.phase->info().updated_lagrangian)
    model.notes.push_back(no_error_bound_note());
  begin("the norm of errors");
  model.learns_omega_1 = !model.omega_1 && steps_tell;
  if (problem.stop.distance > 0 && !model.omega_1 && !model.learns_omega_1) {
    throw_scene_error(
        "stop.distance",
        "a distance is bounded by omega_1, but a factor of the stiffness, which tells it, has no room, and "
        "only linear bodies of one density under steady loads tell it on their way; expected stop.residual, "
        "or fewer cells");
  }
  if (model.omega_1 && !model.multigrid && problem.stop.wants_equilibrium() &&
      !model.phase->info().updated_lagrangian) {
    model.volume_norm =
        set_up.shared("norm", model.mass, [&] { return volume_norm(problem, *model.phase, has_scaled_mass, model.u); });
  }
  if (problem.stop.wants_equilibrium() && problem.stop.time == 0 && LoadSchedule(problem, *model.phase, 0).is_open()) {
    model.notes.push_back(
        "loads or supports go on to depend on t and stop.time is not set: a plateau that outlasts stop.hold counts as "
        "equilibrium");
  }
  if (model.static_method && model.static_method->takes_end_of_loads) model.t = problem.stop.time;
  begin("the damping and the step");
  model.dwell = dwell_of(problem, model);
  model.distance_goal = distance_goal_of(problem, model);
  model.equilibrium_must_last = !model.static_method && !residual_bounds_error(problem, model);
  choose_damping_and_step(problem, set_up, model);
  std::ranges::move(viscosity_notes(problem, model.integrator.max_step), std::back_inserter(model.notes));
  if (model.phase->info().stiffens && !problem.integrator.step) {
    model.initial_stiffening = model.phase->stiffening(0, model.u);
  }
  model.parts = set_up.parts();
  model.spared_s = set_up.spared_s();
  return model;
}

}  // namespace

Model make_model(const Problem& problem, SetUpStore* store) {
  const char* part = "";
  try {
    return make_parts(problem, store, [&](const char* what) {
      heed_stop_request();
      part = what;
    });
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("no memory is left in the set-up for {}; expected fewer cells or points", part));
  }
}

}  // namespace stillpoint

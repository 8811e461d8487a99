#include "simulation/setup/model.hpp"

#include <stillpoint/spectrum.hpp>

#include <array>
#include <new>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "output/probes.hpp"
#include "scene/stages.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/advice/unit_notes.hpp"
#include "simulation/loads/load_schedule.hpp"
#include "simulation/setup/set_up_state.hpp"

namespace stillpoint {
namespace {

// Throws SceneError if R cannot be evaluated where the motion begins.
void check_initial_state(const LagrangianPhase& phase, double t, ConstVec u) {
  std::vector<double> R(phase.size());
  const auto trial = phase.make_trial();
  if (phase.internal_force(t, u, R, *trial)) return;
  throw_scene_error("initial", "the initial state cannot be evaluated: " + phase.diagnosis().refusal(*trial));
}

void make_first_phase(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  model.static_method = plan.static_method;
  model.relaxation = plan.relaxation;
  model.factor_fits = plan.stiffness.factor_fits(plan.room);
  model.method = find_method(problem.integrator.method, problem.integrator.treatment);
  model.phase = parts.phase(problem, set_up.begin);
  model.t = set_up.begin.t;
  model.mass = problem.mass;
}

void begin_at_initial_state(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  Model& model = set_up.model;
  model.u = model.phase->initial_displacement(model.t);
  if (!set_up.begin.carried) check_probes(problem, *model.phase);
  if (plan.static_method) model.phase->move_supports_on(0);  // they move in the shares of the load
  check_initial_state(*model.phase, model.t, model.u);
  const bool linear =
      !model.phase->info().nonlinear && model.phase->tangents().of_loads(model.t, model.u).nonZeros() == 0;
  revise(problem, {.unknowns = static_cast<double>(model.phase->size()), .linear = linear}, plan);
}

void begin_motion(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Model& model = set_up.model;
  choose_mass(set_up);
  set_up.note(model.body_notes.at_start(problem, *model.phase));
  set_up.note(accuracy_notes(problem, *model.phase, model.mass.scaling));
  if (set_up.begin.t == 0) {
    set_up.note(unit_notes(problem));
    set_up.note(load_notes(problem, *model.phase, model.u));
  }
  model.v = model.phase->initial_velocity(model.t);
}

// V and its ω₁; empty if K has no lowest eigenvalue.
std::optional<VolumeNorm> volume_norm(Problem problem, const LagrangianPhase& phase, ConstVec u, const Ranks* ranks) {
  for (auto& [name, material] : problem.materials) {
    material.parameters["rho"] = 1;
    material.by_place.erase("rho");
  }
  problem.mass.scaling = MassScaling::uniform;
  problem.mass.factor = 1;
  VolumeNorm norm{.V = make_phase(problem, {.ranks = ranks})->mass()};
  const FrequencyEstimate lowest = lowest_frequency(phase.tangents().matrix(Tangent::elastic, 0, u), norm.V);
  if (!lowest.converged) return std::nullopt;
  norm.omega_1 = lowest.omega;
  return norm;
}

void choose_norm_of_errors(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  const bool wants_equilibrium = problem.stop.wants_equilibrium();
  model.learns_omega_1 = !model.omega_1 && plan.steps_tell_omega_1;
  if (problem.stop.distance > 0 && !model.omega_1 && !model.learns_omega_1) {
    throw_scene_error(
        "stop.distance",
        "a distance is bounded by omega_1, but a factor of the stiffness, which tells it, has no room, and "
        "only linear bodies of one density under steady loads tell it on their way; expected stop.residual, "
        "or fewer cells");
  }
  if (model.omega_1 && !plan.multigrid && wants_equilibrium && !plan.moves_on) {
    model.volume_norm = parts.shared("norm", model.mass, [&] {
      return plan.estimates.mass_measures_volume ? std::nullopt
                                                 : volume_norm(problem, *model.phase, model.u, set_up.begin.ranks);
    });
  }
  if (wants_equilibrium && problem.stop.time == 0 && LoadSchedule(problem, *model.phase, 0).is_open()) {
    set_up.note(
        "loads or supports go on to depend on t and stop.time is not set: a plateau that outlasts stop.hold counts as "
        "equilibrium");
  }
  if (plan.static_method && plan.static_method->takes_end_of_loads) model.t = end_of_stage(problem);
}

// The time that equilibrium has to last. A body that is not held has no lowest frequency, and a hundred of its shortest
// periods stand in for the longest; with multigrid, whose periods are nearly alike, five. A static solver has no motion
// that may only be turning round.
double dwell_of(const SetUpState& set_up) {
  constexpr double two_pi = 2 * std::numbers::pi;
  const Model& model = set_up.model;
  if (model.static_method) return 0;
  const double shortest_periods = set_up.plan.multigrid ? 5 : 100;
  return set_up.problem.stop.dwell *
         (model.omega_1 ? two_pi / *model.omega_1 : shortest_periods * two_pi / model.omega_max);
}

// The error bound that equilibrium takes: what the problem asks for; beside its residual one by default, which a
// residual that is small only beside the stiffest part's forces does not pass. With contact half of it, as its
// multipliers may be off by as much as the body.
double distance_goal_of(const SetUpState& set_up) {
  constexpr double default_goal = 1e-3;
  const StopSpec& stop = set_up.problem.stop;
  const bool is_known = (set_up.model.omega_1 && !set_up.plan.moves_on) || set_up.model.learns_omega_1;
  if (!(stop.residual > 0 && is_known) || stop.distance.is_asked()) return stop.distance.value();
  return set_up.problem.may_touch() ? default_goal / 2 : default_goal;
}

// The bound ‖u − u*‖ ≤ ‖M⁻¹Q‖/ω₁² holds at every moment in a linear body under steady loads: with the kinetic energy
// small as well, no later moment can be further off. Smooth contact with a body that supports hold leaves it so: its
// potential is convex, and what is nearly in balance is near the rest.
bool residual_bounds_error(const SetUpState& set_up) {
  const Model& model = set_up.model;
  const bool holds_by_itself = !model.phase->info().may_touch || model.phase->shape().free_parts().empty();
  return model.omega_1 && !set_up.plan.nonlinear_law && !set_up.plan.moves_on && !loads_vary(set_up.problem) &&
         !model.phase->contact() && !set_up.problem.rubs() && holds_by_itself;
}

void choose_way_to_rest(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  Model& model = set_up.model;
  model.dwell = dwell_of(set_up);
  model.distance_goal = distance_goal_of(set_up);
  model.equilibrium_must_last = !plan.static_method && !residual_bounds_error(set_up);
  choose_damping_and_step(set_up);
  set_up.note(viscosity_notes(problem, model.integrator.max_step));
  if (model.phase->info().stiffens && !problem.integrator.step)
    model.initial_stiffening = model.phase->stiffening(set_up.begin.t, model.u);
}

struct Part {
  const char* makes;
  void (*run)(SetUpState&);
};
constexpr std::array parts_in_order{
    Part{"the material points, their weights and the mass", &make_first_phase},
    Part{"the initial state", &begin_at_initial_state},
    Part{"the choice of a mass, and the hierarchy of multigrid", &begin_motion},
    Part{"the highest frequency", &find_omega_max},
    Part{"the lowest frequency, with a factor of the stiffness", &find_omega_1},
    Part{"the norm of errors", &choose_norm_of_errors},
    Part{"the damping and the step", &choose_way_to_rest},
};

}  // namespace

Model make_model(const Problem& problem, Plan plan, SetUpStore* store, const PhaseBegin& begin) {
  SetUpState set_up{.problem = problem, .begin = begin, .plan = std::move(plan), .parts = SetUp(store)};
  for (const Part& part : parts_in_order) {
    heed_stop_request();
    try {
      part.run(set_up);
    } catch (const std::bad_alloc&) {
      throw std::runtime_error(
          fmt::format("no memory is left in the set-up for {}; expected fewer cells or points", part.makes));
    }
  }
  set_up.model.phase->move_supports_on(1);
  set_up.model.parts = set_up.parts.parts();
  set_up.model.spared_s = set_up.parts.spared_s();
  return std::move(set_up.model);
}

Model make_model(const Problem& problem, SetUpStore* store) { return make_model(problem, make_plan(problem), store); }

}  // namespace stillpoint

// The highest frequency, which the step needs, and the lowest, by which damping is critical and an error is bounded.
#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "simulation/advice/mechanism.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/setup/set_up_state.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"

namespace stillpoint {
namespace {

// By Lanczos' method, whose answer is above ω_max by no more than its tolerance. A spectrum that is crowded at its end
// keeps it from that: then by power iteration, which underestimates, and, if that has not converged, by ARPACK; with a
// margin, or the guaranteed bound, if that has not either. A large body takes what few applications of K give.
double highest_frequency(const LagrangianPhase& phase, double t, ConstVec u) {
  const bool is_large = phase.size() > direct_solver_limit;
  constexpr double tolerance = 1e-7;
  FrequencyEstimate estimate =
      is_large ? omega_max_by_lanczos(phase, t, u, 30) : omega_max_by_lanczos(phase, t, u, 100, tolerance);
  const SpectrumOptions options{.tolerance = 1e-9, .max_iterations = 300};
  if (!estimate.converged) estimate = omega_max_by_power_iteration(phase, t, u, options);
  if (!(estimate.omega > 0) || !std::isfinite(estimate.omega)) {
    throw_scene_error("initial", fmt::format("the initial state has no highest frequency ({}); expected a stable state",
                                             estimate.status));
  }
  if (estimate.converged) return estimate.omega;
  if (!is_large) {
    const FrequencyEstimate by_arpack = omega_max_by_arpack(phase, t, u, options);
    if (by_arpack.converged) return by_arpack.omega;
  }
  constexpr double margin = 1.02;  // after 300 iterations an underestimate of 0.1 % is usual
  return std::min(margin * estimate.omega, omega_max_bound_by_gershgorin(phase, t, u).omega);
}

// Throws SceneError if something cannot do without ω₁.
void refuse_missing_omega_1(const SetUpState& set_up, const std::string& why) {
  const Omega1Needs& needs = set_up.plan.omega_1;
  if (needs.distance) {
    throw_scene_error(
        "stop.distance",
        fmt::format("a distance is bounded by omega_1, but {}; expected a support, or stop.residual", why));
  }
  if (needs.relaxation) {
    throw_scene_error(
        "damping.strategy",
        fmt::format("'{}' needs omega_1, but {}; expected a support, more points per cell, or another strategy",
                    set_up.plan.relaxation->about.name, why));
  }
  if (needs.critical_damping) {
    throw_scene_error(
        "damping.c",
        fmt::format("critical damping needs omega_1, but {}; expected a support, more points per cell, or a number",
                    why));
  }
}

double share_of_material(const Problem& problem, const Model& model, const FrequencyEstimate& lowest) {
  const bool has_inertia_of_its_own = problem.mass.scaling != MassScaling::uniform;
  if (!lowest.converged || lowest.mode.empty() || has_inertia_of_its_own || !model.phase->mass().is_lumped()) return 1;
  return share_in_material(problem, *model.phase, lowest.mode);
}

// Where points move on, some come into a cell by a part in a million of its length, and functions that reach no more of
// them move as slowly as nothing else does. No error bound counts on them there, and no rest can wait for them. Those
// that are but a little slower than the material are waited for: its stress may not be even before they are at rest.
FrequencyEstimate lowest_of_material(const Model& model, FrequencyEstimate of_all) {
  FrequencyEstimate of_material = lowest_frequency(model.phase->tangents().matrix(Tangent::elastic, model.t, model.u),
                                                   model.phase->fields().material_mass(), model.phase->mass());
  constexpr double too_slow = 0.1;
  return of_material.converged && of_all.omega < too_slow * of_material.omega ? std::move(of_material)
                                                                              : std::move(of_all);
}

}  // namespace

void find_omega_max(SetUpState& set_up) {
  Plan& plan = set_up.plan;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  if (plan.chooses_mass || plan.multigrid) return;
  model.omega_max =
      parts.shared("omega_max", model.mass, [&] { return highest_frequency(*model.phase, model.t, model.u); });
}

void find_omega_1(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  if (plan.multigrid) return;
  if (!plan.omega_1.any()) {
    const bool has_bound = plan.steps_tell_omega_1 || plan.chooses_mass;
    if (!has_bound && problem.stop.wants_equilibrium() && !plan.moves_on) {
      set_up.note(
          "omega_1 is not looked for, as a factor of the stiffness would take longer than the way to rest: there is no "
          "error bound; stop.distance asks for one");
    }
    return;
  }
  FrequencyEstimate lowest =
      parts.shared(part_omega_1, model.mass, [&] { return omega_1_by_lanczos(*model.phase, model.t, model.u); });
  if (const double share = share_of_material(problem, model, lowest); share < least_share_in_material) {
    if (plan.moves_on) {
      lowest = lowest_of_material(model, std::move(lowest));
    } else if (!plan.chooses_mass && !plan.static_method) {
      set_up.note(lowest_mode_note(lowest.omega, share));
    }
  }
  if (lowest.converged) {
    model.omega_1 = lowest.omega;
    return;
  }
  refuse_mechanism(problem, *model.phase, model.u);
  refuse_missing_omega_1(set_up, lowest.status);
  set_up.note(
      fmt::format("omega_1 is not known ({}): equilibrium is held for 100 of the shortest periods", lowest.status));
}

}  // namespace stillpoint

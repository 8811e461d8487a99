// The inertia of a motion to rest: asked for by the problem, or chosen by auto.
#include <stillpoint/spectrum.hpp>

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/pore_water.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/setup/multigrid_mass.hpp"
#include "simulation/setup/set_up_state.hpp"

namespace stillpoint {
namespace {

// A law with a history remembers what yields on the way, and the way of this motion is that of no load.
void refuse_law_with_history(const Plan& plan) {
  if (plan.static_method || !plan.remembers) return;
  throw_scene_error(
      "mass.kind",
      "'multigrid' is a fictitious inertia: its motion takes another path than the load's, and a law with a "
      "history would remember that path; take solve.method = \"newton-cg\" or \"lbfgs\" with it");
}

// Each phase has frequencies of its own: auto finds what it needs of them as it goes.
void refuse_phases(const Problem& problem, const Plan& plan) {
  if (plan.static_method || plan.chooses_mass || !plan.moves_on) return;
  throw_scene_error("mass.kind",
                    fmt::format("'multigrid' goes from phase to phase by damping.strategy = \"auto\" alone, not by "
                                "'{}'; take that, or phase.max_motion = \"none\"",
                                problem.damping.strategy));
}

// The cycle's smoothers and coarse spaces know nothing of motions that keep the volume.
void note_incompressible(SetUpState& set_up) {
  constexpr double slow_ratio = 20;
  for (const auto& [name, material] : set_up.problem.materials) {
    if (!has_E_and_nu(material)) continue;
    const double nu = with_water(material).nu, lambda_over_mu = 2 * nu / (1 - 2 * nu);
    if (!(lambda_over_mu >= slow_ratio)) continue;
    set_up.note(fmt::format(
        "material.{} is nearly incompressible ({}nu = {:.6g}): with a multigrid mass, as without, evaluations grow "
        "with the root of lambda/mu = {:.3g}",
        material.name, material.undrained ? "with its water, " : "", nu, lambda_over_mu));
  }
}

void make_multigrid_as_planned(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  const bool is_asked = problem.mass.kind == MassKind::multigrid;
  if (!plan.multigrid || (!is_asked && !model.phase->shape().free_parts().empty())) return;
  if (is_asked) refuse_law_with_history(plan), refuse_phases(problem, plan);
  MultigridAttempt made = shared_multigrid_mass(parts, problem.mass, *model.phase, model.u,
                                                /*only_omega_max=*/plan.static_method || plan.chooses_mass);
  if (!made.mass) {
    if (is_asked) throw_scene_error("mass.kind", made.refusal);
    return;
  }
  model.multigrid = std::move(made.mass);
  model.omega_max = model.multigrid->omega_max;
  if (model.multigrid->omega_1 > 0) model.omega_1 = model.multigrid->omega_1;
  if (!is_asked) {
    set_up.note(
        fmt::format("auto takes mass.kind = \"multigrid\": with {} unknowns about {:.2g} times as quick as a lumped "
                    "mass",
                    model.phase->size(), plan.multigrid_gain));
  }
  set_up.note(
      "with mass.kind = \"multigrid\" frequencies and velocities are those of a fictitious inertia, and the distance "
      "is that of the strain energy, ‖u − u*‖_K/‖u‖_K");
  note_incompressible(set_up);
}

// ω_max for auto, which counts what it spends.
double quick_omega_max(SetUpState& set_up, const MassSpec& mass, const LagrangianPhase& phase) {
  const double t = set_up.begin.t;
  const FrequencyEstimate estimate = set_up.parts.shared(
      "omega_max of auto", mass, [&] { return omega_max_by_lanczos(phase, t, phase.initial_displacement(t)); });
  set_up.model.tangent_applications += estimate.iterations;
  if (estimate.converged) return estimate.omega;
  throw_scene_error("initial", fmt::format("the initial state has no highest frequency ({}); expected a stable state",
                                           estimate.status));
}

// Both masses have the mass of the body in total, and the slowest mode, in which the body moves as a whole, sees little
// of how it is spread: the ratio of κ is that of ω_max². Gershgorin's bound needs a lumped mass, which auto takes if
// the problem leaves the kind open.
void choose_scaled_mass(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  SetUp& parts = set_up.parts;
  Model& model = set_up.model;
  model.omega_max = quick_omega_max(set_up, problem.mass, *model.phase);
  if (!plan.equilibrium_only) {
    set_up.note(
        "auto keeps the physical mass and halts no motion, as loads or supports depend on t or the transient is asked "
        "for; its c M v holds back a body that flows: take one-sided or cundall there");
  }
  if (!plan.tries_scaled_mass) return;
  Problem scaled = problem;
  scaled.mass.kind = MassKind::lumped;
  scaled.mass.scaling = MassScaling::gershgorin;
  std::unique_ptr<LagrangianPhase> phase = parts.phase(scaled, set_up.begin);
  const double omega_max = quick_omega_max(set_up, scaled.mass, *phase);
  const double gain = model.omega_max * model.omega_max / (omega_max * omega_max);
  constexpr double worthwhile_gain = 1.05;
  if (!(gain >= worthwhile_gain)) return parts.give_back(scaled.mass, std::move(phase));
  std::swap(model.phase, phase);
  parts.give_back(problem.mass, std::move(phase));
  model.mass = scaled.mass;
  model.omega_max = omega_max;
  set_up.note(fmt::format(
      "auto scales the mass by Gershgorin's bound: the condition number becomes about {:.3g} times smaller", gain));
}

}  // namespace

void choose_mass(SetUpState& set_up) {
  const Problem& problem = set_up.problem;
  Plan& plan = set_up.plan;
  Model& model = set_up.model;
  make_multigrid_as_planned(set_up);
  if (plan.chooses_mass && !model.multigrid) choose_scaled_mass(set_up);
  Estimates found = plan.estimates;
  found.unknowns = static_cast<double>(model.phase->size());
  found.multigrid_serves = model.multigrid != nullptr;
  found.mass_measures_volume =
      model.multigrid || mass_measures_volume(problem, model.mass.scaling != MassScaling::uniform);
  revise(problem, found, plan);
}

// A run that may be resumed in this phase makes its cycle anew, which can then be made again.
void follow_multigrid(const Problem& problem, Model& model) {
  if (!model.multigrid) return;
  MultigridAttempt made =
      next_multigrid_mass(*model.phase, problem.checkpoint.wanted() ? nullptr : model.multigrid.get());
  if (!made.mass) throw_scene_error("mass.kind", made.refusal);
  if (model.multigrid_step == 0) model.multigrid_step = model.integrator.max_step * model.omega_max;
  model.multigrid = std::move(made.mass);
  model.omega_max = model.multigrid->omega_max;
  model.integrator.max_step = model.relaxing.max_step = model.multigrid_step / model.omega_max;
}

}  // namespace stillpoint

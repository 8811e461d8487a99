#include "simulation/multigrid_choice.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "linalg/multigrid.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/highest_frequency.hpp"
#include "simulation/multigrid_mass.hpp"

namespace stillpoint {
namespace {

// Seconds on a core of 2022, of which only the ratios count, measured by incompressible.toml with 1e4 to 3e5 unknowns
// and in space by oedometer.toml with 4e4 to 1.5e6: evaluations without multigrid grow with the cells across the body,
// those with it do not, and both cost as much as there are unknowns. In space a row of K has 81 entries for 18, and the
// products of K with the prolongation, which make the coarser levels, grow by as much. A body that turns or buckles on
// its way takes 100 to 1600 with multigrid (cantilever.toml, blocks under their weight), one that hardly does as many
// as a linear one: 150 stand for both.
struct Cost {
  double without, with;  // [s]
};
struct CostOfUnknown {
  double evaluation, set_up, cycle;  // [s]
};
constexpr CostOfUnknown in_the_plane{12e-9, 4.0e-6, 0.15e-6}, in_space{30e-9, 14e-6, 1.2e-6};
constexpr std::array by_dimension{in_the_plane, in_the_plane, in_space};  // a line has too few unknowns to matter

Cost cost_of(const Problem& problem, double unknowns, bool linear) {
  constexpr double per_cell = 7.4;  // evaluations to 1e-6, a cell along the longest side
  constexpr double start = 0.12;    // of PETSc
  const auto [evaluation, set_up, cycle] = by_dimension.at(static_cast<std::size_t>(problem.dim - 1));
  const double cells = *std::ranges::max_element(problem.grid.cells);
  const double cycles = linear ? 15 : 150;
  return {per_cell * cells * evaluation * unknowns, start + (set_up + cycles * cycle) * unknowns};
}

bool is_open(const Problem& problem) {
  return !problem.mass.scaling_is_asked() && !problem.mass.kind.is_asked() && wants_equilibrium_only(problem) &&
         problem.stop.distance <= 0 && problem.grid.basis != BasisKind::hermite && !problem.grid.cells.empty();
}

bool is_auto(const Model& model) { return model.relaxation && model.relaxation->chooses_mass; }

// Whether auto may: it then comes to the same rest with any mass, in a body that its supports hold.
bool may_choose(const Model& model) {
  const LagrangianPhase& phase = *model.phase;
  return is_auto(model) && phase.info().history_names.empty() && !phase.info().updated_lagrangian && !phase.contact();
}

// What yields on the way of a motion is remembered, and this motion's way is that of no load.
void refuse_what_remembers(const Model& model) {
  if (model.static_method || model.phase->info().history_names.empty()) return;
  throw_scene_error(
      "mass.kind",
      "'multigrid' is a fictitious inertia: its motion takes another path than the load's, and a law with a "
      "history would remember that path; take solve.method = \"newton-cg\" or \"lbfgs\" with it");
}

// Each phase has frequencies of its own: auto finds what it needs of them as it goes.
void refuse_phases(const Problem& problem, const Model& model) {
  if (model.static_method || is_auto(model) || !model.phase->info().updated_lagrangian) return;
  throw_scene_error("mass.kind",
                    fmt::format("'multigrid' goes from phase to phase by damping.strategy = \"auto\" alone, not by "
                                "'{}'; take that, or phase.max_motion = \"none\"",
                                problem.damping.strategy));
}

// The cycle's smoothers and coarse spaces know nothing of motions that keep the volume.
void note_incompressible(const Problem& problem, std::vector<std::string>& notes) {
  constexpr double much = 20;
  for (const auto& [name, material] : problem.materials) {
    const auto nu = material.parameters.find("nu");
    if (nu == material.parameters.end()) continue;
    const double lambda_over_mu = 2 * nu->second / (1 - 2 * nu->second);
    if (!(lambda_over_mu >= much)) continue;
    notes.push_back(fmt::format(
        "material.{} is nearly incompressible (nu = {:.6g}): with a multigrid mass, as without, evaluations grow with "
        "the root of lambda/mu = {:.3g}",
        material.name, nu->second, lambda_over_mu));
  }
}

}  // namespace

bool multigrid_pays(const Problem& problem, double unknowns, bool linear) {
  if (!is_open(problem)) return false;
  const Cost cost = cost_of(problem, unknowns, linear);
  return cost.without > cost.with && multigrid_is_missing().empty();
}

void choose_multigrid(const Problem& problem, SetUp& set_up, Model& model) {
  const bool is_asked = problem.mass.kind == MassKind::multigrid;
  const auto unknowns = static_cast<double>(model.phase->size());
  if (!is_asked && !(may_choose(model) && multigrid_pays(problem, unknowns, model.linear) &&
                     model.phase->shape().free_parts().empty()))
    return;
  if (is_asked) refuse_what_remembers(model), refuse_phases(problem, model);
  MultigridAttempt made = shared_multigrid_mass(set_up, problem.mass, *model.phase, model.u,
                                                /*only_omega_max=*/model.static_method || is_auto(model));
  if (!made.mass) {
    if (is_asked) throw_scene_error("mass.kind", made.refusal);
    return;
  }
  model.multigrid = std::move(made.mass);
  model.omega_max = model.multigrid->omega_max;
  if (model.multigrid->omega_1 > 0) model.omega_1 = model.multigrid->omega_1;
  if (!is_asked) {
    const Cost cost = cost_of(problem, unknowns, model.linear);
    model.notes.push_back(
        fmt::format("auto takes mass.kind = \"multigrid\": with {} unknowns about {:.2g} times as quick as a lumped "
                    "mass",
                    model.phase->size(), cost.without / cost.with));
  }
  model.notes.push_back(
      "with mass.kind = \"multigrid\" frequencies and velocities are those of a fictitious inertia, and the distance "
      "is that of the strain energy, ‖u − u*‖_K/‖u‖_K");
  note_incompressible(problem, model.notes);
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

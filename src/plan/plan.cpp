#include "plan/plan.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "linalg/multigrid.hpp"
#include "plan/catalogue.hpp"
#include "scene/dimensions.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"
#include "solvers/statics/static_methods.hpp"

namespace stillpoint {
namespace {

template <class Holds>
bool some_law(const Problem& problem, const Holds& holds) {
  return std::ranges::any_of(problem.bodies, [&](const BodySpec& body) {
    return holds(*catalogue().law(problem.materials.at(body.material).law));
  });
}

// Seconds on a core of 2022, of which only the ratios count, measured by incompressible.toml with 1e4 to 3e5 unknowns
// and in space by oedometer.toml with 4e4 to 1.5e6: evaluations without multigrid grow with the cells across the body,
// those with it do not, and both cost as much as there are unknowns. In space a row of K has 81 entries for 18, and the
// products of K with the prolongation, which make the coarser levels, grow by as much. A body that turns or buckles on
// its way takes 100 to 1600 with multigrid (cantilever.toml, blocks under their weight), one that hardly does as many
// as a linear one: 150 stand for both.
struct CostOfUnknown {
  double evaluation, set_up, cycle;  // [s]
};
constexpr CostOfUnknown cost_in_plane{12e-9, 4.0e-6, 0.15e-6}, cost_in_space{30e-9, 14e-6, 1.2e-6};
// A line has too few unknowns to matter.
constexpr std::array cost_by_dimension{cost_in_plane, cost_in_plane, cost_in_space};

// The time without multigrid over the time with it, of an elastic body in a single phase that nothing touches.
double gain_by_multigrid(const Problem& problem, const BodySize& size, const Estimates& found) {
  constexpr double evaluations_per_cell = 7.4;  // to a residual of 1e-6, for each cell along the body's longest side
  constexpr double start_of_petsc = 0.12;       // [s]
  const auto [evaluation, set_up, cycle] = of_dimension(cost_by_dimension, problem.dim);
  const double cycles = found.linear ? 15 : 150;
  return evaluations_per_cell * size.longest * evaluation * found.unknowns /
         (start_of_petsc + (set_up + cycles * cycle) * found.unknowns);
}

// auto comes to the same rest with any mass, in a body whose law has no history and which nothing touches.
bool may_choose_multigrid(const Problem& problem, const Plan& plan) {
  return plan.chooses_mass && plan.equilibrium_only && !plan.remembers && !plan.moves_on && problem.walls.empty() &&
         !problem.may_touch() && !problem.mass.scaling_is_asked() && !problem.mass.kind.is_asked() &&
         problem.stop.distance <= 0 && problem.grid.basis != BasisKind::hermite && !problem.grid.cells.empty();
}

Omega1Needs needs_of_omega_1(const Problem& problem, const Plan& plan) {
  // Some ways to rest work without ω₁, and the factor of a large body alone would cost more than the way to rest.
  const bool large = (plan.chooses_mass || plan.steps_tell_omega_1) &&
                     static_cast<std::size_t>(plan.estimates.unknowns) > direct_solver_limit;
  const bool is_cheap = !large && plan.stiffness.factor_is_cheap();
  const bool distance =
      problem.stop.distance > 0 && !(large && (plan.steps_tell_omega_1 || !plan.stiffness.factor_fits(plan.room)));
  const IntegratorSpec& integrator = problem.integrator;
  const bool moves = !plan.static_method;
  return {.critical_damping = moves && plan.strategy->uses("c") && !problem.damping.c,
          .tolerances = moves && integrator.rtol && !(integrator.atol_u && integrator.atol_v),
          .relaxation = plan.relaxation && plan.relaxation->needs_omega_1,
          .distance = distance,
          .useful = problem.stop.wants_equilibrium() && (is_cheap || distance)};
}

bool solves_by_factor(const Problem& problem, const Plan& plan) {
  return plan.static_method && plan.static_method->is_newton &&
         linear_solver_of(problem.solve.method) != LinearSolver::iterative;
}

}  // namespace

Plan make_plan(const Problem& problem, const MemoryRoom& room) {
  Plan plan;
  plan.room = room;
  plan.size = body_size(problem);
  plan.stiffness = matrix_size(problem, plan.size);
  plan.strategy = catalogue().strategy(problem.damping.strategy);
  plan.static_method = catalogue().static_method(problem.solve.method);
  if (!plan.static_method) plan.relaxation = find_relaxation(problem.damping.strategy);
  const bool law_remembers = some_law(problem, [](const LawInfo& law) { return law.history_dependent; });
  plan.remembers = law_remembers || problem.rubs();
  plan.nonlinear_law = law_remembers || some_law(problem, [](const LawInfo& law) { return law.finite_strain; });
  plan.nonlinear = plan.nonlinear_law || problem.may_touch();
  plan.moves_on = problem.phase.ends();
  plan.equilibrium_only = problem.stop.wants_equilibrium() && !loads_vary(problem);
  plan.chooses_mass = plan.relaxation && plan.relaxation->chooses_mass;
  const bool kind_is_fixed = problem.mass.kind.is_asked() && problem.mass.kind == MassKind::consistent;
  plan.tries_scaled_mass = plan.chooses_mass && plan.equilibrium_only && !problem.mass.scaling_is_asked() &&
                           !kind_is_fixed && problem.grid.basis != BasisKind::hermite;
  revise(problem, {.unknowns = plan.size.unknowns, .linear = !plan.nonlinear}, plan);
  plan_memory(problem, plan);
  return plan;
}

void revise(const Problem& problem, const Estimates& found, Plan& plan) {
  plan.estimates = found;
  plan.multigrid_gain = may_choose_multigrid(problem, plan) ? gain_by_multigrid(problem, plan.size, found) : 0;
  const bool is_asked = problem.mass.kind == MassKind::multigrid;
  plan.multigrid = found.multigrid_serves && (is_asked || (plan.multigrid_gain > 1 && multigrid_is_missing().empty()));
  const bool tells = plan.static_method ? plan.static_method->tells_omega_1 : plan.chooses_mass;
  plan.steps_tell_omega_1 =
      tells && plan.equilibrium_only && found.linear && !plan.moves_on && found.mass_measures_volume;
  plan.omega_1 = needs_of_omega_1(problem, plan);
  plan.factorises = solves_by_factor(problem, plan) || plan.omega_1.any();
}

bool mass_measures_volume(const Problem& problem, bool scaled) {
  const auto all_share = [&](auto property) {
    return std::ranges::adjacent_find(problem.bodies, std::ranges::not_equal_to{}, property) == problem.bodies.end();
  };
  if (scaled) return all_share(&BodySpec::material);
  if (std::ranges::any_of(problem.bodies, [&](const BodySpec& body) {
        return problem.materials.at(body.material).by_place.contains("rho");
      }))
    return false;
  return all_share([&](const BodySpec& body) { return problem.materials.at(body.material).parameters.at("rho"); });
}

}  // namespace stillpoint

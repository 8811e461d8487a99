#include "simulation/omega_1_needs.hpp"

#include <stillpoint/relaxation.hpp>

#include "simulation/catalogue.hpp"
#include "simulation/matrix_size.hpp"
#include "simulation/scene_motion.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"

namespace stillpoint {

Omega1Needs omega_1_needs(const Problem& problem, std::size_t unknowns, bool steps_tell) {
  const bool is_static = problem.solve.is_static();
  const StrategyInfo& strategy = *catalogue().strategy(problem.damping.strategy);
  const RelaxationInfo* relaxation = is_static ? nullptr : find_relaxation(strategy.name);
  // They work without, and of a large body the factor alone would cost more than the way to rest.
  const bool large = (chooses_mass(problem) || steps_tell) && unknowns > direct_solver_limit;
  const bool is_cheap = !large && factor_is_cheap(problem, body_size(problem));
  const bool distance = problem.stop.distance > 0 && !(large && (steps_tell || !has_room_for_factor(problem)));
  return {
      .critical_damping = !is_static && strategy.uses("c") && !problem.damping.c,
      .tolerances = !is_static && problem.integrator.rtol && !(problem.integrator.atol_u && problem.integrator.atol_v),
      .relaxation = relaxation && relaxation->needs_omega_1,
      .distance = distance,
      .useful = problem.stop.wants_equilibrium() && (is_cheap || distance)};
}

}  // namespace stillpoint

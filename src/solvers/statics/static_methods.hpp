// Static solvers, R(u) = F without time, as the steps of a simulation: a step is a new iterate, or with Newton's method
// the whole solution.
#pragma once

#include <stillpoint/integrator.hpp>
#include <stillpoint/mass.hpp>
#include <stillpoint/static_solution.hpp>

#include <memory>
#include <string_view>
#include <vector>

namespace stillpoint {

struct StaticMethodOptions {
  std::string_view name;  // one of static_methods()
  double max_step = 0;    // below leapfrog's critical step, for the first try along M⁻¹Q [s]; > 0
  double tolerance = 0;   // of ‖F − R‖/‖F‖, at which Newton's method and increments of the load end; > 0
  int load_steps = 1;     // at least
};

/// Every static solver, in the order of `stillpoint list`.
const std::vector<StaticMethodInfo>& static_methods();

/// How one of Newton's methods solves K du = Q.
LinearSolver linear_solver_of(std::string_view name);

/// Of that one of Newton's methods, with the load in equal shares.
NewtonOptions newton_options(std::string_view name, int load_steps);

/// Newton's method with an inverse mass for its preconditioner; K is assembled, as it has had room before, for that
/// mass. M outlives the options.
void precondition(NewtonOptions& options, const Mass& M);

/// y = [u; 0]. What points remember is committed at the end of each increment of the load but the last.
/// Throws std::invalid_argument for an unknown name, and if something touches the body.
std::unique_ptr<Integrator> make_static_method(const StaticMethodOptions& options, RelaxationSystem& system);

// One file each:
std::unique_ptr<Integrator> make_cg(const StaticMethodOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_lbfgs(const StaticMethodOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_newton(const StaticMethodOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

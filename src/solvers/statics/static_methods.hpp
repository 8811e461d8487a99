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
  std::string_view name;              // one of static_methods()
  double max_step = 0;                // a step below leapfrog's critical one, for the first try along M⁻¹Q [s]; > 0
  double tolerance = 0;               // ‖F − R‖/‖F‖ at which Newton's method and load increments end; > 0
  int load_steps = 1;                 // increments of the load, at least
  bool closes_with_friction = false;  // whether contact with friction may close: the first increments are small
};

/// Every static solver, in the order of `stillpoint list`.
const std::vector<StaticMethodInfo>& static_methods();

/// The linear solver by which the Newton method of this name solves K du = Q.
LinearSolver linear_solver_of(std::string_view name);

/// The options of the Newton method of this name, with the load in equal shares.
NewtonOptions newton_options(std::string_view name, int load_steps);

/// Gives Newton's method an inverse mass as its preconditioner. K is assembled: making that mass already took room for
/// it. M has to outlive the options.
void precondition(NewtonOptions& options, const Mass& M);

/// Makes the static solver for y = [u; 0]. The points' history is committed at the end of each load increment but the
/// last. Throws std::invalid_argument for an unknown name, and if the body has contact.
std::unique_ptr<Stepper> make_static_method(const StaticMethodOptions& options, RelaxationSystem& system);

// Each of these has a file of its own:
std::unique_ptr<Stepper> make_cg(const StaticMethodOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_lbfgs(const StaticMethodOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_newton(const StaticMethodOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

// The families of integrators, each with its methods and a maker that takes one of them. A maker takes fixed steps
// without options.rtol and adaptive ones with it, and throws std::invalid_argument for a damping treatment that its
// scheme does not have, or that does not fit the system's damping and mass.
#pragma once

#include <stillpoint/integrator.hpp>

#include <memory>
#include <vector>

namespace stillpoint {

/// The two schemes of our own, which cost one force evaluation a step.
Method leapfrog_method(DampingTreatment treatment);
Method symplectic_euler_method(DampingTreatment treatment);
std::unique_ptr<Stepper> make_leapfrog(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_symplectic_euler(const IntegratorOptions& options, RelaxationSystem& system);

/// SUNDIALS' ARKODE (ERKStep): erk:<table> for every explicit table of the installed one, and for three of our own.
std::vector<Method> erk_methods();
std::unique_ptr<Stepper> make_erk(const IntegratorOptions& options, RelaxationSystem& system);

/// GSL's steppers, a second opinion: gsl:rk2, rk4, rkf45, rkck, rk8pd with fixed or adaptive steps, and gsl:msadams,
/// adaptive only.
std::vector<Method> gsl_methods();
std::unique_ptr<Stepper> make_gsl(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

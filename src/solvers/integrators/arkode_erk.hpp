// SUNDIALS' ARKODE, explicit Runge–Kutta (ERKStep), behind the Integrator interface.
#pragma once

#include <stillpoint/integrator.hpp>

#include <memory>
#include <vector>

namespace stillpoint {

/// One method erk:<table> for every explicit table of the installed ARKODE, and for three tables that are built in.
std::vector<Method> erk_methods();

/// options.method is one of erk_methods(). Fixed steps without rtol, adaptive with it.
std::unique_ptr<Integrator> make_erk(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

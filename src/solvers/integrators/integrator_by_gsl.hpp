// GSL's explicit steppers behind the Integrator interface: a second opinion, independent of SUNDIALS.
#pragma once

#include <stillpoint/integrator.hpp>

#include <memory>
#include <vector>

namespace stillpoint {

/// gsl:rk2, rk4, rkf45, rkck, rk8pd with fixed or adaptive steps, and gsl:msadams, adaptive only.
std::vector<Method> gsl_methods();

/// options.method is one of gsl_methods(). Fixed steps without rtol, adaptive with it.
std::unique_ptr<Integrator> make_gsl(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

// The two schemes that cost one force evaluation a step: leapfrog and symplectic Euler.
#pragma once

#include <stillpoint/integrator.hpp>

#include <memory>

namespace stillpoint {

/// The methods. Both functions throw std::invalid_argument for a damping treatment that the scheme does not have.
Method leapfrog_method(DampingTreatment treatment);
Method symplectic_euler_method(DampingTreatment treatment);

/// The integrators. Both functions throw std::invalid_argument for a damping treatment that the scheme does not have,
/// or that does not fit the system's damping and mass.
std::unique_ptr<Integrator> make_leapfrog(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_symplectic_euler(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

// The strategies that own their iteration, a file each.
#pragma once

#include <stillpoint/integrator.hpp>

#include <memory>

namespace stillpoint {

/// The iteration of system.damping(), one whose DampingInfo::owns_iteration is true. Throws std::invalid_argument for
/// options that it cannot work with.
std::unique_ptr<Integrator> make_strategy(const IntegratorOptions& options, RelaxationSystem& system);

std::unique_ptr<Integrator> make_kinetic(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_adaptive(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_papadrakakis(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_fire(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_fire2(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_chebyshev(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_nesterov(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_cg(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_lbfgs(const IntegratorOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_auto(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

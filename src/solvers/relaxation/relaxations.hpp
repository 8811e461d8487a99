// The relaxations, a file each.
#pragma once

#include <stillpoint/relaxation.hpp>

#include <memory>

namespace stillpoint {

std::unique_ptr<Integrator> make_kinetic(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_adaptive(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_papadrakakis(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_fire(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_fire2(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_chebyshev(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_nesterov(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Integrator> make_auto(const RelaxationOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

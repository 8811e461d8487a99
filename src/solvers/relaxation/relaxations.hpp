// The relaxations, a file each.
#pragma once

#include <stillpoint/own_relaxation.hpp>

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
/// By what a program has added.
std::unique_ptr<Integrator> make_own_relaxation(const RelaxationOptions& options, RelaxationSystem& system,
                                                const MakeOwnRelaxation& make);
/// A further row, or another one in the place of that of the same name.
void put_relaxation(const RelaxationInfo& info, MakeOwnRelaxation make);

}  // namespace stillpoint

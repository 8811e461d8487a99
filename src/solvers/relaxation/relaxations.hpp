// The constructors of the relaxations; each relaxation has a file of its own.
#pragma once

#include <stillpoint/own_relaxation.hpp>

#include <memory>

namespace stillpoint {

std::unique_ptr<Stepper> make_kinetic(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_adaptive(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_papadrakakis(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_fire(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_fire2(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_chebyshev(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_nesterov(const RelaxationOptions& options, RelaxationSystem& system);
std::unique_ptr<Stepper> make_auto(const RelaxationOptions& options, RelaxationSystem& system);
/// A relaxation that the calling program has added, made by `make`.
std::unique_ptr<Stepper> make_own_relaxation(const RelaxationOptions& options, RelaxationSystem& system,
                                             const MakeOwnRelaxation& make);
/// Adds a row to the table of relaxations, or replaces the row of the same name.
void put_relaxation(const RelaxationInfo& info, MakeOwnRelaxation make);

}  // namespace stillpoint

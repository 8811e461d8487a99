// What a scene tells of its motion before anything of it is made.
#pragma once

#include <stillpoint/problem.hpp>

namespace stillpoint {

/// Whether the law of some body remembers.
bool remembers(const Problem& problem);
/// Whether the law of some body is not linear.
bool is_nonlinear(const Problem& problem);
/// Whether the relaxation, if the scene has one, finds its own mass, as auto does.
bool chooses_mass(const Problem& problem);

/// What is asked of a motion before its steps may tell omega_1.
struct Motion {
  bool linear = false, moves_on = false;
  bool mass_measures_volume = true;  // or its inertia is that of multigrid
};
/// Whether the steps of the relaxation, or of the static solver, tell omega_1 of the motions that the loads drive.
bool steps_tell_omega_1(const Problem& problem, const Motion& motion);

}  // namespace stillpoint

// The highest frequency of a scene, which its step needs, and the mass that a relaxation chooses by it.
#pragma once

#include <stillpoint/problem.hpp>

#include "simulation/model.hpp"

namespace stillpoint {

/// Whether nothing but equilibrium is asked for, under loads that stay: then inertia is free, and velocities may be
/// reset.
bool wants_equilibrium_only(const Problem& problem);

/// ω_max for the step [rad/s]. Throws SceneError if the initial state has none.
double highest_frequency(const LagrangianPhase& phase, ConstVec u);

/// Physical masses or those by Gershgorin's bound, whichever gives the smaller κ: sets phase, omega_max, and what it
/// spent on them. True if it took the latter. store: as of make_model().
bool choose_mass(const Problem& problem, Model& model, SetUp& set_up, SetUpStore* store);

}  // namespace stillpoint

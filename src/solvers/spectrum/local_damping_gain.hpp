// How local damping and a mass that is no diagonal raise the highest frequency.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/semi_discrete.hpp>

namespace stillpoint {

/// By how much local damping raises ω_max beyond its stiffness_factor(): 1 for a lumped mass. With a consistent one
/// damping at one node moves its neighbours (see the source).
double local_damping_gain(const SemiDiscrete& system, double t, ConstVec u, const Damping& damping, double omega_max);

}  // namespace stillpoint

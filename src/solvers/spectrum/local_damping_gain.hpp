// The rise of the highest frequency by local damping together with a mass that is not diagonal.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/semi_discrete.hpp>

namespace stillpoint {

/// The factor by which local damping raises ω_max beyond its stiffness_factor(): 1 for a lumped mass. With a consistent
/// mass the damping of one node moves its neighbours (see the source).
double local_damping_gain(const SemiDiscrete& system, double t, ConstVec u, const Damping& damping, double omega_max);

}  // namespace stillpoint

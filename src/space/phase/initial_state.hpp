// The state of the material points when a run begins.
#pragma once

#include <stillpoint/problem.hpp>

#include "space/points/body.hpp"

namespace stillpoint {

/// Sets the stress of level ground, if the scene asks for it, then parameters that are formulas of the position. The
/// stress is in balance with the weight above each point, dσ_yy/dy + ρ b_y = 0, and σ_xx = σ_zz = K0 σ_yy. Each body
/// weighs by its own density, and between the topmost one and the surface there is more of it; where the surface of a
/// body is not known, as of points from a file, each point takes its own density all the way up. Then the laws are told
/// where their points are. Throws SceneError if a parameter is out of range somewhere, or a law cannot answer there.
template <Kinematics K>
void set_initial_state(const Problem& problem, Body<K>& body);

/// Sets the velocities of points that move on from phase to phase.
template <Kinematics K>
void set_initial_velocity(const Problem& problem, Body<K>& body);

}  // namespace stillpoint

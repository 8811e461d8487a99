// The state of the material points when a run begins.
#pragma once

#include <stillpoint/problem.hpp>

#include "space/points/body.hpp"

namespace stillpoint {

/// Sets the stress of level ground, if the scene asks for it, then parameters that are formulas of the position:
/// ∂σ_yy/∂y
/// + ρ b_y = 0 from the surface through the bodies above each point, each with its own density, and σ_xx = σ_zz = K0
/// σ_yy. Between the bodies and the surface there is more of the topmost one. Throws SceneError if a parameter is out
/// of range somewhere.
template <Kinematics K>
void set_initial_state(const Problem& problem, Body<K>& body);

/// Sets the velocities of points that move on from phase to phase.
template <Kinematics K>
void set_initial_velocity(const Problem& problem, Body<K>& body);

}  // namespace stillpoint

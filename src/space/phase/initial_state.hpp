// The state of the material points when a run begins.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "space/points/body.hpp"

namespace stillpoint {

/// Sets the stress that the scene asks for, then parameters that are formulas of the position when the run began,
/// `origin`, by the points' numbers, (P × dim); empty: points are where they were then. The stress of level ground is
/// in balance with the weight above each point, dσ_yy/dy + ρ b_y = 0, and σ_xx = σ_zz = K0 σ_yy of the effective stress
/// σ + p_w I, with the pressure p_w of water at rest in the pores of undrained materials. Each body weighs by its own
/// density, and between the topmost one and the surface there is more of it; where the surface of a body is not known,
/// as of points from a file, each point takes its own density all the way up. Finds the smallest density of each
/// material. Throws SceneError if a parameter is out of range somewhere, or a law cannot begin under the stress.
template <Kinematics K>
void set_initial_state(const Problem& problem, Body<K>& body, const std::vector<double>& origin);

/// What users should know of the stress that the scene asks for: where it lies outside the strength of a material.
template <Kinematics K>
std::vector<std::string> notes_on_initial_stress(const Problem& problem, const Body<K>& body);

/// Sets the velocities of points that move on from phase to phase.
template <Kinematics K>
void set_initial_velocity(const Problem& problem, Body<K>& body);

}  // namespace stillpoint

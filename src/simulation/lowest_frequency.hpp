// The lowest frequency of a scene, by which damping is critical and an error is bounded.
#pragma once

#include <stillpoint/problem.hpp>

#include "simulation/model.hpp"
#include "simulation/omega_1_needs.hpp"

namespace stillpoint {

/// ω₁ of the model by Lanczos' method on K⁻¹M. Where there is none: throws SceneError if something cannot do without,
/// leaves a note if equilibrium can.
void find_omega_1(const Problem& problem, const Omega1Needs& needs, SetUp& set_up, Model& model);

}  // namespace stillpoint

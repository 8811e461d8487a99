// The error of a state against the scene's exact solution.
#pragma once

#include <stillpoint/summary.hpp>

#include <optional>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// ‖u_h − u‖/‖u‖ over the material points with weights V_p, at (t, u); stress as of the last commit.
/// Empty if the scene gives no exact solution or it vanishes.
std::optional<ExactError> exact_error(const Scene& scene, const LagrangianPhase& phase, double t, ConstVec u);

}  // namespace stillpoint

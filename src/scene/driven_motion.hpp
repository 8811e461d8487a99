// Scenes in which a displacement drives the body in time.
#pragma once

#include <stillpoint/problem.hpp>

namespace stillpoint {

/// True if a support, a wall or a rigid body moves in time, or a displacement drives loads, and no equilibrium is asked
/// for: the result is the forces during the motion.
bool is_driven(const Problem& problem);

/// True if that motion goes on up to the end, over more than one phase: the material flows as long as the run lasts.
bool is_driven_flow(const Problem& problem);

/// The default of damping.alpha.
double usual_alpha(const Problem& problem);

}  // namespace stillpoint

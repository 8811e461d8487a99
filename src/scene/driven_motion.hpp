// Scenes in which a displacement drives the body in time.
#pragma once

#include <stillpoint/problem.hpp>

namespace stillpoint {

/// Whether a support or a wall moves in time, or a displacement drives loads, and no equilibrium is asked for: what the
/// scene is about are the forces on the way.
bool is_driven(const Problem& problem);

/// Whether that goes on up to the end, over more phases than one: material flows as long as the run lasts.
bool is_driven_flow(const Problem& problem);

/// The default of damping.alpha.
double usual_alpha(const Problem& problem);

}  // namespace stillpoint

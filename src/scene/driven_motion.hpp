// Scenes in which a displacement drives the body in time.
#pragma once

#include <stillpoint/scene.hpp>

namespace stillpoint {

/// Whether a support or a wall moves in time, or a displacement drives loads, and no equilibrium is asked for: what the
/// scene is about are the forces on the way.
bool is_driven(const Scene& scene);

/// Whether that goes on up to the end, over more phases than one: material flows as long as the run lasts.
bool is_driven_flow(const Scene& scene);

/// The default of damping.alpha.
double usual_alpha(const Scene& scene);

}  // namespace stillpoint

// The ground of later stages, before the first one begins.
#pragma once

#include <stillpoint/scene.hpp>

namespace stillpoint {

/// Throws SceneError, with its location, if a parameter that is a formula of the position has no value that its law
/// allows somewhere in a body that a later stage places or changes: a run is not to come upon it in its midst.
void check_ground_of_later_stages(Scene scene);

}  // namespace stillpoint

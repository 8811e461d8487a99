// Which loads of a scene a displacement drives ([load]), and which act as they are given.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// "traction[0]", "force[2]", "body_force": the names of all loads that a scene has.
std::vector<std::string> names_of_loads(const Scene& scene);

/// The scene with the loads that [load] drives, without any support or wall; with no load at all if there is no [load].
Scene reference_loads(const Scene& scene);
/// The scene without these.
Scene without_reference_loads(const Scene& scene);

}  // namespace stillpoint

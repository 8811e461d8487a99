// What has to hold between the parts of a scene.
#pragma once

#include <stillpoint/scene.hpp>

#include <vector>

namespace stillpoint {

/// Checks a scene of which every single value is in order, or left empty because it was not; reports all that does not
/// fit together. Places that miss the grid or the body by rounding are moved onto its border.
void validate(Scene& scene, std::vector<Problem>& problems);

}  // namespace stillpoint

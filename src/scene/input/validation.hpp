// What has to hold between the parts of a scene.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/scene.hpp>

#include "scene/input/toml_value.hpp"

namespace stillpoint {

/// Completes a scene with the defaults that depend on other keys, and checks that its parts fit together; each single
/// value is right, or was left at its default because it was wrong. Positions that miss the grid or the body by
/// rounding are moved onto its border.
void validate(Scene& scene, Reading& reading, const Catalogue& catalogue);

}  // namespace stillpoint

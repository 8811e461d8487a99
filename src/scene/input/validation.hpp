// What has to hold between the parts of a scene.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/scene.hpp>

#include <vector>

#include "scene/input/toml_value.hpp"
#include "scene/resolve.hpp"

namespace stillpoint {

/// Checks that the parts of a resolved scene fit together; each single value is right, or was left at its default
/// because it was wrong. files: what is wrong with those that bodies name.
void validate(const Scene& scene, const std::vector<FileMistake>& files, Reading& reading, const Catalogue& catalogue);

}  // namespace stillpoint

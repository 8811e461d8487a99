// The keys of a scene: which there are, what type each has, what its limits are.
#pragma once

#include "scene/input/toml_reader.hpp"

namespace stillpoint {

/// Fills everything of a scene that is written in TOML; constants must be in reading already. False where the scene's
/// dimension is not supported, so that reading on would only produce nonsense.
bool read_schema(TableReader& root, Scene& scene);

}  // namespace stillpoint

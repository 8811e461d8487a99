// The refinement of a scene: the keys it changes, by how much, and the size that results.
#pragma once

#include <stillpoint/converge.hpp>

#include "study/setting.hpp"

namespace stillpoint {

/// The settings that make the refined quantity `factor` times finer than in the scene. Throws SceneError
/// if the scene has no such quantity.
Settings refined(const Problem& problem, Refinement refinement, double factor);

/// The size of the refined quantity in a scene that took steps of `step` [s].
double size_of(const Problem& problem, Refinement refinement, double step);

}  // namespace stillpoint

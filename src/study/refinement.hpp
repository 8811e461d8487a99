// How a scene is refined: which keys, by how much, and what size that is.
#pragma once

#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// The settings, "key=value", that make what is refined `factor` times finer than in the scene. Throws SceneError if
/// the scene has nothing of the kind.
std::vector<std::string> refined(const Problem& problem, Refinement refinement, double factor);

/// The size of it in a scene that took steps of `step` [s].
double size_of(const Problem& problem, Refinement refinement, double step);

}  // namespace stillpoint

// The refinement of a scene: the keys it changes, by how much, the size that results, and the source of error that it
// reduces.
#pragma once

#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

#include "study/setting.hpp"

namespace stillpoint {

/// The settings that make the refined quantity `factor` times finer than in the scene. Throws SceneError
/// if the scene has no such quantity.
Settings refined(const Problem& problem, Refinement refinement, double factor);

/// The size of the refined quantity in a scene that took steps of `step` [s].
double size_of(const Problem& problem, Refinement refinement, double step);

/// A source of error, and the settings that reduce it alone.
struct RefinedSource {
  std::string name;
  Settings set;
};

/// The sources of a scene's error, except those that are refined from level to level.
std::vector<RefinedSource> other_sources(const Problem& problem, const std::vector<Refinement>& refined);

/// The name of the source of error that a refinement reduces: "space", "quadrature", "phases" or "time".
std::string source_of(Refinement refinement);

/// Whether a scene follows a motion in time, so that its error depends on the step.
bool is_transient(const Problem& problem);

}  // namespace stillpoint

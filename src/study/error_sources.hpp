// The largest source of error of a scene, found by refining each source alone.
#pragma once

#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

#include "study/setting.hpp"

namespace stillpoint {

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

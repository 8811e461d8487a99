// Which error of a scene is the largest: each of its sources alone made finer.
#pragma once

#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// A source of error, and the settings, "key=value", that make it alone smaller.
struct RefinedSource {
  std::string name;
  std::vector<std::string> set;
};

/// Those of a scene, but for what is refined from level to level.
std::vector<RefinedSource> other_sources(const Problem& problem, const std::vector<Refinement>& refined);

/// "space", "quadrature", "phases" or "time".
std::string source_of(Refinement refinement);

/// Whether a scene follows a motion in time, whose error depends on the step.
bool is_transient(const Problem& problem);

}  // namespace stillpoint

// The combinations that a comparison tries.
#pragma once

#include <stillpoint/compare.hpp>
#include <stillpoint/scene.hpp>

#include <string>
#include <vector>

namespace stillpoint {

struct Candidate {
  ComparedRun run;         // only its names are filled in
  bool is_newton = false;  // solved as a whole, not step by step
  bool is_extra = false;   // not asked for: left out if the scene refuses it
};

/// integrators × strategies × step fractions (or tolerances if a method is named "…:adaptive"), with a multigrid mass
/// if a strategy is named "…:multigrid"; a strategy with an iteration of its own has only that. transient: strategies
/// do not vary, the scene's own is used. Throws SceneError for an unknown name, with the option and the nearest known
/// name.
std::vector<Candidate> candidates(const CompareOptions& options, const Problem& problem, bool transient);

/// The scene with what the names of a run say, resolved and checked anew. Numbers that belong to another strategy's
/// damping or steps are left out. Throws SceneError.
Scene scene_of(const ComparedRun& run, const Scene& scene);

}  // namespace stillpoint

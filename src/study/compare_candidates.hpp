// The combinations that a comparison tries, each as overrides of the scene.
#pragma once

#include <stillpoint/compare.hpp>

#include <string>
#include <vector>

namespace stillpoint {

struct Candidate {
  ComparedRun run;                     // named, and empty otherwise
  std::vector<std::string> overrides;  // "key=value"
  bool is_newton = false;              // solved as a whole, not step by step
  bool is_extra = false;               // left out if the scene refuses it, as nobody has asked for it
};

/// integrators × strategies × step fractions (or tolerances if a method is named "…:adaptive"), with a multigrid mass
/// if a strategy is named "…:multigrid"; a strategy that owns its iteration has only its own. transient: strategies do
/// not vary, the scene's own is what moves. Throws SceneError on a name that is none, naming the option and the nearest
/// name that is one.
std::vector<Candidate> candidates(const CompareOptions& options, const Scene& scene, bool transient);

/// Whether a key of the scene, "damping.alpha", says anything to a strategy.
bool takes(const std::string& strategy, const std::string& key);

}  // namespace stillpoint

// One relaxation of a scene, watched from outside: how far it is from the exact discrete equilibrium after each step.
#pragma once

#include <stillpoint/compare.hpp>

#include <functional>

#include "exact_state.hpp"

namespace stillpoint {

struct TrialLimits {
  double goal = 1e-6;
  bool by_residual = false;  // whether the goal is one of the residual
  long evaluations = 0;
  double seconds = 0;
  const ExactState* ramp = nullptr;  // the limit of slow loading, to tell an overshoot
  std::function<bool()> interrupted{};
};

/// Fills run.status, reason, counts, samples and last values. The scene's integrator and damping are those to try.
void watch_trial(const Scene& scene, const ExactState& exact, const TrialLimits& limits, ComparedRun& run);

/// Takes the same number of steps again and looks at nothing. Returns the wall time of the steps [s].
double time_trial(const Scene& scene, long steps);

}  // namespace stillpoint

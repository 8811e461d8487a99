// One relaxation of a scene, watched from outside: how far it is from the exact discrete equilibrium after each step.
#pragma once

#include <stillpoint/compare.hpp>

#include <functional>

#include "study/reference_solution.hpp"

namespace stillpoint {

struct BenchmarkLimits {
  double goal = 1e-6;
  bool by_residual = false;  // whether the goal is one of the residual
  long evaluations = 0;
  double seconds = 0;
  const ReferenceSolution* ramp = nullptr;  // the limit of slow loading, to tell an overshoot
  std::function<bool()> interrupted{};
};

/// Fills run.status, reason, counts, samples and last values. The scene's integrator and damping are those to try.
void run_benchmark(const Scene& scene, const ReferenceSolution& exact, const BenchmarkLimits& limits, ComparedRun& run);

/// Takes the same number of steps again and looks at nothing. Returns the wall time of the steps [s].
double time_benchmark(const Scene& scene, long steps, int threads);

}  // namespace stillpoint

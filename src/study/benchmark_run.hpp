// One relaxation of a scene, observed from outside: its distance from the exact discrete equilibrium as it runs.
#pragma once

#include <stillpoint/compare.hpp>

#include <functional>

#include "simulation/setup/model.hpp"
#include "simulation/setup/set_up_store.hpp"
#include "study/reference_solution.hpp"

namespace stillpoint {

struct BenchmarkLimits {
  double goal = 1e-6;
  bool by_residual = false;  // whether the goal is a residual
  long evaluations = 0;
  double seconds = 0;
  int threads = 1;
  const ReferenceSolution* ramp = nullptr;  // limit of slow loading, relative to which an overshoot is measured
  std::function<bool()> interrupted{};
};

/// Fills run.status, reason, counts, samples, last values and the set-up. The scene's integrator and damping are those
/// to try. Returns the wall time of the steps alone, without the measurements between them, until the run had
/// converged; for a run that does not converge, that of all its steps [s].
double run_benchmark(const Scene& scene, const ReferenceSolution& exact, const BenchmarkLimits& limits,
                     SetUpStore& store, ComparedRun& run);

/// Takes the same number of steps again without measurements. Returns the wall time of the steps [s].
double time_benchmark(const Scene& scene, long steps, int threads, SetUpStore& store);

/// Fills in the set-up costs of a simulation without a store; seconds: the time for the parts that were not in the
/// store.
void fill_set_up(const Model& model, double seconds, ComparedRun& run);

}  // namespace stillpoint

// One relaxation of a scene, watched from outside: how far it is from the exact discrete equilibrium on its way.
#pragma once

#include <stillpoint/compare.hpp>

#include <functional>

#include "simulation/model.hpp"
#include "simulation/set_up_store.hpp"
#include "study/reference_solution.hpp"

namespace stillpoint {

struct BenchmarkLimits {
  double goal = 1e-6;
  bool by_residual = false;  // whether the goal is one of the residual
  long evaluations = 0;
  double seconds = 0;
  int threads = 1;
  const ReferenceSolution* ramp = nullptr;  // the limit of slow loading, to tell an overshoot
  std::function<bool()> interrupted{};
};

/// Fills run.status, reason, counts, samples, last values and the set-up. The scene's integrator and damping are those
/// to try. Returns the wall time of the steps alone, what is looked at between them left out, until it had arrived; of
/// a run that does not, of all its steps [s].
double run_benchmark(const Problem& problem, const ReferenceSolution& exact, const BenchmarkLimits& limits,
                     SetUpStore& store, ComparedRun& run);

/// Takes the same number of steps again and looks at nothing. Returns the wall time of the steps [s].
double time_benchmark(const Problem& problem, long steps, int threads, SetUpStore& store);

/// What setting a simulation up costs one that has no store: seconds for what was not there.
void fill_set_up(const Model& model, double seconds, ComparedRun& run);

}  // namespace stillpoint

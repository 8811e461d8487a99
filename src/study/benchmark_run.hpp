// One run of a comparison, observed from outside: a relaxation's distance from the exact discrete equilibrium as it
// runs, or a transient's error in time.
#pragma once

#include <stillpoint/compare.hpp>

#include <functional>
#include <string>
#include <vector>

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

/// The much more accurate motion relative to which displacements at stop.time are compared.
struct TransientReference {
  std::vector<double> displacement;  // of the points, (P × dim) [m]
  std::string what;
};

/// The motion with the scene's own damping: by an integrator of order 7 at rtol 1e-11 if it is smooth, by leapfrog at a
/// sixteenth of the critical step if there are history-dependent laws, contact or several phases.
TransientReference transient_reference(const Scene& scene, SetUpStore& store);

/// Fills the row, with a single sample at stop.time. Returns the wall time of the steps [s].
double run_transient(const Scene& scene, const TransientReference& reference, int threads,
                     const std::function<bool()>& interrupted, SetUpStore& store, ComparedRun& run);
/// The wall time of the steps of the same run [s].
double time_transient(const Scene& scene, int threads, SetUpStore& store);

}  // namespace stillpoint

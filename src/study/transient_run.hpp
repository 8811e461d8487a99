// The error in time: the points' displacements at stop.time relative to those of a much more accurate motion.
#pragma once

#include <stillpoint/compare.hpp>

#include <functional>
#include <string>
#include <vector>

#include "simulation/setup/set_up_store.hpp"

namespace stillpoint {

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

// Runs a scene from its start to its end, with files.
#pragma once

#include <stillpoint/simulation.hpp>

namespace stillpoint {

/// Simulates the scene until it is done; options.out receives history.csv, the fields, summary.json and report.html.
/// Throws SceneError if it cannot be set up (nothing is written then), std::filesystem_error if files cannot be
/// written. A run that goes wrong returns its status, with what it had until then in the files.
Summary run(const Scene& scene, const SimulationOptions& options = {});

}  // namespace stillpoint

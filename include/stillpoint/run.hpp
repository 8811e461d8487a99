// Runs a scene from its start to its end, with files.
#pragma once

#include <stillpoint/simulation.hpp>

namespace stillpoint {

/// Simulates the scene until it is done; options.out receives history.csv, the fields, summary.json and report.html.
/// Throws SceneError if the scene cannot be set up (nothing is written then), std::filesystem_error if files cannot be
/// written. A run that fails returns its status, and the files hold the results up to then.
Summary run(const Scene& scene, const SimulationOptions& options = {});

}  // namespace stillpoint

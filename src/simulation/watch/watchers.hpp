// The watchers that nobody but their list knows: each has a file of its own. The run outlives them.
#pragma once

#include "simulation/watcher.hpp"

namespace stillpoint {

std::unique_ptr<Watcher> watch_single_phase();
std::unique_ptr<Watcher> watch_left_in_points();
std::unique_ptr<Watcher> watch_rate_share(const RunState& run);
std::unique_ptr<Watcher> watch_plastic_path(const RunState& run);

}  // namespace stillpoint

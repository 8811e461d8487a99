// What a run leaves that was to end before it began.
#pragma once

#include <stillpoint/simulation.hpp>

namespace stillpoint {

/// Its summary, which is not written yet. A history of no rows is, if the run begins anew: one that goes on has its
/// own. Throws as Simulation.
Summary leave_stopped_set_up(const Problem& problem, const SimulationOptions& options, const SetUpStopped& stopped);

}  // namespace stillpoint

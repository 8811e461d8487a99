// Whether the points of a saved phase are in an order that loops over them can take.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <cstdint>
#include <string>

namespace stillpoint {

/// What of the points, as a phase saves them, would send a loop elsewhere than to n points in a grid of `cells`; empty:
/// nothing does, or none are saved, as in a single phase.
std::string fault_of_saved_points(const SavedState& saved, std::int64_t n, std::int64_t cells);

}  // namespace stillpoint

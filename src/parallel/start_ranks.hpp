// Starts the ranks of a run that a launcher of MPI has begun.
#pragma once

#include <memory>

#include "parallel/ranks.hpp"

namespace stillpoint {

/// The ranks of the launched copies, of which this process is one. Throws std::runtime_error if there is no module for
/// them.
std::shared_ptr<const Ranks> start_ranks();

}  // namespace stillpoint

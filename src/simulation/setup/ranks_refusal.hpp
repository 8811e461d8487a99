// What a scene cannot have if ranks share its points.
#pragma once

#include <stillpoint/problem.hpp>

namespace stillpoint {

/// Throws a SceneError about the first thing of the problem that ranks are not offered yet, with what to take instead.
void refuse_what_ranks_lack(const Problem& problem);

}  // namespace stillpoint

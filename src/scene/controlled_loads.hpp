// Which loads of a scene a displacement drives ([load]), and which act as they are given.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// "traction[0]", "force[2]", "body_force": the names of all loads that a scene has.
std::vector<std::string> names_of_loads(const Problem& problem);

/// Of a scene with a [load]: with the loads that it drives, and no support or wall.
Problem reference_loads(const Problem& problem);
/// The scene without these; as it is if there is no [load].
Problem without_reference_loads(const Problem& problem);

}  // namespace stillpoint

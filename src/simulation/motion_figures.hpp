// The displacements that a scene prescribes, which stand in the history beside the forces that they take.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// "<wall>.motion" along the face's coordinate, and "<name>.motion_x" … of rigid bodies and of supports with a name (in
/// one dimension "<name>.motion"), if it is a formula of t alone. Supports that stages begin or end have none.
std::vector<std::string> motion_columns(const Problem& problem);
/// The values of these columns at t [m].
std::vector<double> motion_values(const Problem& problem, double t);

}  // namespace stillpoint

// The loads of a scene that a displacement drives ([load]), and those that act as they are given.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// "traction[0]", "force[2]": what [load] calls a load, by its number in all stages.
std::string name_of_load(const TractionSpec& traction);
std::string name_of_load(const PointForceSpec& force);
/// "traction[0]", "force[2]", "body_force": the names of all loads that a scene has now and later.
std::vector<std::string> names_of_loads(const Problem& problem);
/// Whether the [load] of a problem, now or later, drives a load of this name.
bool is_driven(const Problem& problem, const std::string& name);

/// The problem of a scene with a [load], with only the loads that it drives, and with no support, wall or rigid
/// body.
Problem reference_loads(const Problem& problem);
/// The problem without the loads that [load] drives; unchanged if there is no [load].
Problem without_reference_loads(const Problem& problem);

}  // namespace stillpoint

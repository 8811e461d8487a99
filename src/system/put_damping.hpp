// How a damping of a program's own gets its row.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/own_damping.hpp>

namespace stillpoint {

/// A further row of dampings(), or another one in the place of that of the same name.
void put_damping(const StrategyInfo& about, double stiffness_factor, OwnDampingForce force);

}  // namespace stillpoint

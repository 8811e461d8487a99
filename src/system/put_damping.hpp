// The registration of a damping that the calling program supplies.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/own_damping.hpp>

namespace stillpoint {

/// Adds a row to dampings(), or replaces the row of the same name.
void put_damping(const StrategyInfo& about, double stiffness_factor, OwnDampingForce force);

}  // namespace stillpoint

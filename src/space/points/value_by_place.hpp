// The values of parameters that are formulas of the position.
#pragma once

#include <stillpoint/problem.hpp>

#include <span>
#include <string>

namespace stillpoint {

/// What a parameter of a material is at a position before the motion; of one that is no formula, its number. Throws
/// SceneError if that is not among the values that the law allows.
double value_by_place(const MaterialSpec& material, const std::string& name, std::span<const double> position);

}  // namespace stillpoint

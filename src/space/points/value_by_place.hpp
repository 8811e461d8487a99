// The values of parameters that are formulas of the position.
#pragma once

#include <stillpoint/problem.hpp>

#include <span>
#include <string>
#include <vector>

#include "space/materials/point_material.hpp"

namespace stillpoint {

/// What a parameter of a material is at a position before the motion; of one that is no formula, its number. Throws
/// SceneError if that is not among the values that the law allows.
double value_by_place(const MaterialSpec& material, const std::string& name, std::span<const double> position);
/// The same at several positions.
std::vector<double> values_by_place(const MaterialSpec& material, const std::string& name,
                                    const std::vector<std::vector<double>>& positions);
/// What a law takes by place for its initial state alone, likewise.
InitialGround initial_ground(const MaterialSpec& material, const std::vector<std::vector<double>>& positions);

}  // namespace stillpoint

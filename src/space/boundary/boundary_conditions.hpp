// The boundary conditions of a scene.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>

#include <memory>
#include <vector>

#include "space/boundary/boundary_condition.hpp"

namespace stillpoint {

template <int Dim>
using BoundaryConditions = std::vector<std::unique_ptr<BoundaryCondition<Dim>>>;

/// Makes the boundary conditions that the scene has, in the order in which their forces are summed. The problem must
/// outlive them; grid: that of the first phase; time_scale: see PrescribedMotion.
template <Kinematics K>
BoundaryConditions<dimensions(K)> make_boundary_conditions(const Problem& problem, const Grid<dimensions(K)>& grid,
                                                           double time_scale);

}  // namespace stillpoint

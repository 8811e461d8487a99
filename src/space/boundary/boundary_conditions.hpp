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

/// Those that the scene has, in the order in which their forces are summed. The problem outlives them; grid: the first
/// one; time_scale: of PrescribedMotion.
template <Kinematics K>
BoundaryConditions<dimensions(K)> make_boundary_conditions(const Problem& problem, const Grid<dimensions(K)>& grid,
                                                           double time_scale);

}  // namespace stillpoint

// The kinds of boundary conditions, a row each.
#pragma once

#include <memory>

#include "space/boundary/body_force.hpp"
#include "space/boundary/own_body_force.hpp"
#include "space/boundary/point_forces.hpp"
#include "space/boundary/supports.hpp"
#include "space/boundary/tractions.hpp"
#include "space/boundary/walls.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
using BoundaryConditions = std::vector<std::unique_ptr<BoundaryCondition<B, K>>>;

/// Those that the scene has, in the order in which their forces are summed. The scene outlives them; grid: the first
/// one; time_scale: of PrescribedMotion.
template <AxisBasis B, Kinematics K>
BoundaryConditions<B, K> make_boundary_conditions(const Scene& scene, const Grid<dimensions(K)>& grid,
                                                  double time_scale) {
  BoundaryConditions<B, K> all;
  if (!scene.supports.empty()) all.push_back(std::make_unique<Supports<B, K>>(scene, time_scale));
  if (!scene.walls.empty()) all.push_back(std::make_unique<Walls<B, K>>(scene, time_scale));
  if (!scene.forces.empty()) all.push_back(std::make_unique<PointForces<B, K>>(scene));
  if (!scene.body_force.empty()) all.push_back(std::make_unique<BodyForce<B, K>>(scene));
  if (!scene.own_load.empty()) all.push_back(std::make_unique<OwnBodyForceCondition<B, K>>(scene));
  if (!scene.tractions.empty()) all.push_back(std::make_unique<Tractions<B, K>>(scene, grid));
  return all;
}

}  // namespace stillpoint

// The kinds of boundary conditions, a row each.
#include "space/boundary/boundary_conditions.hpp"

#include "space/boundary/body_force.hpp"
#include "space/boundary/own_body_force.hpp"
#include "space/boundary/point_forces.hpp"
#include "space/boundary/supports.hpp"
#include "space/boundary/tractions.hpp"
#include "space/boundary/walls.hpp"

namespace stillpoint {

template <Kinematics K>
BoundaryConditions<dimensions(K)> make_boundary_conditions(const Scene& scene, const Grid<dimensions(K)>& grid,
                                                           double time_scale) {
  constexpr int dim = dimensions(K);
  BoundaryConditions<dim> all;
  if (!scene.supports.empty()) all.push_back(std::make_unique<Supports<dim>>(scene, time_scale));
  if (!scene.walls.empty()) all.push_back(std::make_unique<Walls<dim>>(scene, time_scale));
  if (!scene.forces.empty()) all.push_back(std::make_unique<PointForces<dim>>(scene));
  if (!scene.body_force.empty()) all.push_back(std::make_unique<BodyForce<dim>>(scene));
  if (!scene.own_load.empty()) all.push_back(std::make_unique<OwnBodyForceCondition<dim>>(scene));
  if (!scene.tractions.empty()) all.push_back(std::make_unique<Tractions<K>>(scene, grid));
  return all;
}

template BoundaryConditions<1> make_boundary_conditions<Kinematics::line>(const Scene&, const Grid<1>&, double);
template BoundaryConditions<2> make_boundary_conditions<Kinematics::plane>(const Scene&, const Grid<2>&, double);
template BoundaryConditions<2> make_boundary_conditions<Kinematics::axisymmetric>(const Scene&, const Grid<2>&, double);
template BoundaryConditions<3> make_boundary_conditions<Kinematics::space>(const Scene&, const Grid<3>&, double);

}  // namespace stillpoint

// The kinds of boundary conditions, one on each line.
#include "space/boundary/boundary_conditions.hpp"

#include "space/boundary/body_force.hpp"
#include "space/boundary/own_body_force.hpp"
#include "space/boundary/point_forces.hpp"
#include "space/boundary/supports.hpp"
#include "space/boundary/tractions.hpp"
#include "space/boundary/walls.hpp"

namespace stillpoint {

template <Kinematics K>
BoundaryConditions<dimensions(K)> make_boundary_conditions(const Problem& problem, const Grid<dimensions(K)>& grid,
                                                           double time_scale) {
  constexpr int dim = dimensions(K);
  BoundaryConditions<dim> all;
  if (!problem.supports.empty()) all.push_back(std::make_unique<Supports<dim>>(problem, time_scale));
  if (!problem.walls.empty()) all.push_back(std::make_unique<Walls<dim>>(problem, time_scale));
  if (!problem.forces.empty()) all.push_back(std::make_unique<PointForces<dim>>(problem));
  if (!problem.body_force.empty()) all.push_back(std::make_unique<BodyForce<dim>>(problem));
  if (!problem.own_load.empty()) all.push_back(std::make_unique<OwnBodyForceCondition<dim>>(problem));
  if (!problem.tractions.empty()) all.push_back(std::make_unique<Tractions<K>>(problem, grid));
  return all;
}

template BoundaryConditions<1> make_boundary_conditions<Kinematics::line>(const Problem&, const Grid<1>&, double);
template BoundaryConditions<2> make_boundary_conditions<Kinematics::plane>(const Problem&, const Grid<2>&, double);
template BoundaryConditions<2> make_boundary_conditions<Kinematics::axisymmetric>(const Problem&, const Grid<2>&,
                                                                                  double);
template BoundaryConditions<3> make_boundary_conditions<Kinematics::space>(const Problem&, const Grid<3>&, double);

}  // namespace stillpoint

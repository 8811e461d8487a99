// How a phase takes its sums over material points: what a plan of it and the phase itself have to agree on.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>

namespace stillpoint {

/// Whether points share their change of volume; on a line there is nothing to share.
inline bool averages_dilatation(const Problem& problem) {
  return problem.dim > 1 && problem.phase.dilatation != Dilatation::points;
}
/// Whether they share it over splines, which have the degree p − 1 (SplineMeans); otherwise over cells.
inline bool means_over_splines(const Problem& problem) {
  return averages_dilatation(problem) && problem.phase.dilatation == Dilatation::splines &&
         degree_of(problem.grid.basis) > 1;
}
/// Whether the moments of the points in each cell stand in for the points (ElasticCells): in bilinear or trilinear
/// cells with R(u) = K u, whose points have the same stiffness. nonlinear: whether some law is not linear.
inline bool moments_stand_in_for_points(const Problem& problem, bool nonlinear) {
  return problem.dim > 1 && problem.state != StressState::axisymmetric && problem.grid.basis == BasisKind::linear &&
         problem.phase.quadrature == Quadrature::points && !nonlinear && !problem.phase.ends() && !problem.geostatic &&
         std::ranges::none_of(problem.bodies, [&](const BodySpec& body) {
           return problem.materials.at(body.material).by_place.contains("E");
         });
}

}  // namespace stillpoint

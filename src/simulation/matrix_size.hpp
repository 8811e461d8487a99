// What a stiffness matrix and its factor take of memory, from the scene alone. Measured on plates of 8e4 to 1e6
// unknowns, and on lines.
#pragma once

#include <stillpoint/problem.hpp>

#include "simulation/body_size.hpp"

namespace stillpoint {

/// Whether the cells or splines of a scene share their change of volume.
inline bool averages_dilatation(const Problem& problem) { return problem.phase.dilatation != Dilatation::points; }
/// Splines whose means points share are those of degree p − 1, see SplineMeans.
inline bool means_over_splines(const Problem& problem) {
  return problem.phase.dilatation == Dilatation::splines && degree_of(problem.grid.basis) > 1;
}

/// Of K, of its factor, and of the block of a column for every neighbour, of all functions of the grid, from which a
/// matrix is made [bytes].
double bytes_of_matrix(const Problem& problem, const BodySize& size);
double bytes_of_factor(const Problem& problem, const BodySize& size);
double bytes_of_assembly(const Problem& problem, const BodySize& size);

/// Whether a run that can do without a factor of K may make one.
bool has_room_for_factor(const Problem& problem);
/// Whether a factor of K costs about as much as a relaxation, or less, as in the plane; in space it costs as many times
/// more as there are cells across half of the body.
bool factor_is_cheap(const Problem& problem, const BodySize& size);

}  // namespace stillpoint

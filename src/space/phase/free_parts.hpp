// Parts of the body that nothing holds along an axis, and that could move off as a whole.
#pragma once

#include <vector>

#include "parallel/of_all.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/kernels/point_functions.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// An occupied cell: the first of its functions in the grid, from which the others follow, and one of its points.
struct CellOfPart {
  int first_function = 0, point = 0;
};

/// The cells of the points of all ranks, in the order of the whole body.
template <int Dim>
std::vector<CellOfPart> cells_of_parts(const MaterialPoints<Dim>& points, const PointFunctions<Dim>& weights,
                                       const Ranks* ranks);

/// Finds the free parts. weights: by which functions of a cell follow from its first one. first_axis: 1 if
/// axisymmetric, as hoop stress resists all radial motion. sprung: whether a spring of a support acts on an unknown of
/// the grid. as_one: whether parts that share no function count as one part.
template <int Dim>
std::vector<FreePart> find_free_parts(const std::vector<CellOfPart>& cells, const PointFunctions<Dim>& weights,
                                      const GridFunctions<Dim>& functions, int first_axis, const DegreesOfFreedom& dofs,
                                      const std::vector<char>& sprung, bool as_one);

}  // namespace stillpoint

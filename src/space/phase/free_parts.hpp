// Parts of the body that nothing holds along an axis, and that could move off as a whole.
#pragma once

#include <vector>

#include "space/kernels/point_functions.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The data of a phase by which parts of its body are found.
template <int Dim>
struct BodyOnGrid {
  const GridFunctions<Dim>& functions;
  const MaterialPoints<Dim>& points;
  const PointFunctions<Dim>& weights;
};

/// Finds the free parts. first_axis: 1 if axisymmetric, as hoop stress resists all radial motion. sprung: whether a
/// spring of a support acts on an unknown of the grid. as_one: whether parts that share no function count as one part.
template <int Dim>
std::vector<FreePart> find_free_parts(const BodyOnGrid<Dim>& body, int first_axis, const DegreesOfFreedom& dofs,
                                      const std::vector<char>& sprung, bool as_one);

}  // namespace stillpoint

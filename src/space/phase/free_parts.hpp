// Parts of the body that nothing holds along an axis: what could move off as a whole.
#pragma once

#include <vector>

#include "space/kernels/point_functions.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// What of a phase tells parts of its body apart.
template <int Dim>
struct BodyOnGrid {
  const GridFunctions<Dim>& functions;
  const MaterialPoints<Dim>& points;
  const PointFunctions<Dim>& weights;
};

/// first_axis: 1 if axisymmetric, as all points move outwards against hoop stress. sprung: whether a spring of a
/// support acts on an unknown of the grid. as_one: whether what shares no function counts as one part all the same.
template <int Dim>
std::vector<FreePart> find_free_parts(const BodyOnGrid<Dim>& body, int first_axis, const DegreesOfFreedom& dofs,
                                      const std::vector<char>& sprung, bool as_one);

}  // namespace stillpoint

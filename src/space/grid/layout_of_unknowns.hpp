// The positions of the free unknowns of a grid.
#pragma once

#include <utility>

#include "linalg/nodal_layout.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/grid_functions.hpp"

namespace stillpoint {

/// The positions are those at which the coefficients of a linear motion equal the motion; empty for a basis with
/// slopes.
template <int Dim>
NodalLayout layout_of(const GridFunctions<Dim>& functions, const DegreesOfFreedom& dofs) {
  if (!functions.partition_of_unity()) return {};
  NodalLayout layout;
  layout.dim = Dim;
  int function = -1, nodes = 0;
  for (const int unknown : dofs.free) {
    if (std::exchange(function, unknown / Dim) != unknown / Dim) {
      ++nodes;
      for (int d = 0; d < Dim; ++d) layout.positions.push_back(functions.centre(function, d));
    }
    layout.node.push_back(nodes - 1);
    layout.component.push_back(unknown % Dim);
  }
  return layout;
}

}  // namespace stillpoint

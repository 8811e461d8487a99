// Where the points of a body are, and what each takes of its cell.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct PlacedPoints {
  std::size_t dim = 0;
  std::vector<int> bodies;       // (P)
  std::vector<double> x, share;  // (P × dim) [m]; of the volume of a cell that is filled, (P)
};
PlacedPoints place_points(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);

}  // namespace stillpoint

// Where the points of a body are, and what each takes of its cell.
#pragma once

#include <stillpoint/problem.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct PlacedPoints {
  std::size_t dim = 0;
  std::vector<int> bodies;       // (P)
  std::vector<double> x, share;  // (P × dim) [m]; of the volume of a cell that is filled, (P)
};
PlacedPoints place_points(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);

/// How full the cells are that have points, by their numbers along each axis.
using FilledCells = std::map<std::array<long, 3>, double>;
/// Of a phase that begins at t = 0.
FilledCells filled_cells(const Problem& problem, const LagrangianPhase& phase);

}  // namespace stillpoint

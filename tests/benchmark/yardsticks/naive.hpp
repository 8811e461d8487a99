// A step written as the formulas have it, a point and a function after the other: what the yardsticks are checked by.
#pragma once

#include <array>
#include <vector>

#include "block.hpp"

namespace yardsticks {

/// The values and gradients of the functions of a cell at a place in it; local function a + n (b + n c), n = degree
/// + 1.
struct FunctionsAt {
  std::vector<double> value;
  std::vector<std::array<double, 3>> gradient;  // [1/m]
};
FunctionsAt functions_at(const Grid& grid, const std::array<double, 3>& place);

/// The node of each function of a cell, as functions_at() counts them.
std::vector<std::size_t> nodes_of_cell(const Grid& grid, std::size_t cell);

enum class Answer { elastic, on_the_cone, cut };

/// Takes the points of a cell through the increment du, adds their forces to R, and says what the law did with each.
std::vector<Answer> naive_forces(const Grid& grid, std::size_t cell, const std::vector<double>& du,
                                 std::vector<PointState>& points, std::vector<double>& R);

}  // namespace yardsticks

// The material points at one time of a run, as they are written to files.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace stillpoint {

/// A field at the points, (points × components) row by row: 1 component is a scalar, 2 or 3 are a vector, 4 a symmetric
/// tensor in the plane and 6 one in space, xx, yy, zz, xy, yz, zx.
struct PointField {
  std::string name;  // letters, digits and _
  int components;
  std::vector<double> values;
  std::string unit = {};  // "Pa"; empty: none, or not known
};

/// Where the components of such a tensor stand, row and column.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tensor_places{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// The material points at time t [s], and the grid behind them.
struct FieldFrame {
  double t;
  int dim;
  std::size_t points;            // > 0
  std::vector<double> position;  // (points × dim) [m], deformed
  std::vector<PointField> fields;
  std::vector<int> material;                         // (points), or empty: not written
  std::vector<std::vector<double>> grid_lines = {};  // along each axis, or empty: not written [m]
};

/// Throws std::invalid_argument if its parts do not have the shapes above.
void validate(const FieldFrame& frame);

}  // namespace stillpoint

// The treatment of material points that a phase takes past a face of the grid.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/parallel_loop.hpp"
#include "scene/support_kind.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The faces of a grid. A point past a face by a rounding error is put back onto it. At a face with a support or a
/// wall, a point that a step leaves behind it by less than a tenth of a cell is put back as well (nodes follow a wall
/// that sets out suddenly to the order of the integrator). Further away a point has left the grid. An axis of symmetry
/// that the body reaches counts as such a face.
template <int Dim>
class GridFaces {
 public:
  GridFaces(const Problem& problem, const Grid<Dim>& grid, bool is_at_axis = false) : grid_(grid) {
    constexpr double rounding = 1e-12;  // some thousand units in the last place of the largest coordinate
    for (std::size_t d = 0; d < Dim; ++d) {
      const Axis& axis = grid.axes[d];
      slack_[d].fill(rounding * std::max({std::abs(axis.min()), std::abs(axis.max()), axis.max() - axis.min()}));
    }
    for (const SupportSpec& support : problem.supports) {
      if (support.face && !holds_by_springs(problem.grid, support)) hold(*support.face);
    }
    for (const WallSpec& wall : problem.walls) hold(wall.face);
    if (is_at_axis) hold(Face::left);
  }

  /// Whether a point may stay at coordinate x, if necessary after put_back(). False for a NaN.
  bool keeps(int d, double x) const {
    const Axis& axis = grid_.axes[d];
    return x >= axis.min() - slack_[d][0] && x <= axis.max() + slack_[d][1];
  }
  void put_back(MaterialPoints<Dim>& points) const {
    for (int d = 0; d < Dim; ++d) {
      for_each_index(points.size(), [x = points.x[d].data(), min = grid_.axes[d].min(),
                                     max = grid_.axes[d].max()](std::size_t p) { x[p] = std::clamp(x[p], min, max); });
    }
  }

 private:
  void hold(Face face) {
    constexpr double share = 0.1;
    const auto d = static_cast<std::size_t>(axis_of(face));
    const auto& nodes = grid_.axes[d].nodes;
    const double cell = is_upper(face) ? nodes.back() - nodes[nodes.size() - 2] : nodes[1] - nodes[0];
    slack_[d][is_upper(face) ? 1 : 0] = share * cell;
  }

  const Grid<Dim>& grid_;
  std::array<std::array<double, 2>, Dim> slack_;  // past the lower and the upper end of each axis [m]
};

}  // namespace stillpoint

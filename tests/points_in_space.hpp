// Material points in cells of three dimensions, for tests and benchmarks of what is below a phase.
#pragma once

#include <stillpoint/scene.hpp>

#include <cstddef>
#include <vector>

#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/grid.hpp"
#include "space/kernels/nodal_force.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint::test {

/// `count(cell number)` points in each cell, whose places in it are place(point, axis), 0 to 1; equal volumes in a
/// cell, density 1.
template <class Count, class Place>
MaterialPoints<3> points_in_cells(const Grid<3>& grid, const Count& count, const Place& place) {
  MaterialPoints<3> points;
  points.cell_begin = {0};
  for (int number = 0; number < grid.cells(); ++number) {
    const int here = count(number);
    if (here == 0) continue;
    const auto cell = grid.cell_at(number);
    double volume = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto line = static_cast<std::size_t>(cell[d]);
      const double left = grid.axes[d].nodes[line], side = grid.axes[d].nodes[line + 1] - left;
      volume *= side;
      for (int q = 0; q < here; ++q) points.x[d].push_back(left + side * place(q, static_cast<int>(d)));
    }
    for (int q = 0; q < here; ++q) {
      points.volume.push_back(volume / here);
      points.mass.push_back(volume / here);
      points.number.push_back(static_cast<int>(points.number.size()));
    }
    points.cell.push_back(number);
    points.cell_begin.push_back(static_cast<int>(points.volume.size()));
  }
  points.material_begin = {0, static_cast<int>(points.volume.size())};
  return points;
}

/// The sums over the corners of the occupied cells; functions: their number in the grid.
template <AxisBasis B, Kinematics K>
CornerSum corners_of(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights,
                     std::size_t functions) {
  std::vector<int> function_of_corner;
  for (std::size_t k = 0; k < points.cells(); ++k)
    for (int a = 0; a < weights.functions_of_cell(); ++a) function_of_corner.push_back(weights.function(k, a));
  CornerSum corners;
  corners.rebuild(function_of_corner, functions);
  return corners;
}

/// Of one material on a grid of n × n × n cells, eight points in each, nothing held.
template <AxisBasis B = BSpline<1>>
struct CubeOfCells {
  using Basis = TensorBasis<B, 3>;
  Grid<3> grid;
  MaterialPoints<3> points;
  PointWeights<B, Kinematics::space> weights;
  DegreesOfFreedom dofs;
  CornerSum corner_sum;
  NodalForce<B, Kinematics::space> force;
  typename NodalForce<B, Kinematics::space>::Work work;

  explicit CubeOfCells(int n)
      : grid{{Axis::uniform(0, 1, n), Axis::uniform(0, 1, n), Axis::uniform(0, 1, n)}},
        points(points_in_cells(
            grid, [](int) { return 8; }, [](int q, int axis) { return (q >> axis & 1) != 0 ? 0.75 : 0.25; })),
        dofs(std::vector<char>(static_cast<std::size_t>(Basis::count(grid)), 1), 3, {}) {
    weights.rebuild(grid, points);
    corner_sum = corners_of(points, weights, static_cast<std::size_t>(Basis::count(grid)));
    force.rebuild(points, weights, corner_sum);
  }
};

}  // namespace stillpoint::test

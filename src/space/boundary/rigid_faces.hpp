// The treatment of material points that a phase takes past the border of their body into a rigid one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "space/boundary/touch_finder.hpp"
#include "space/grid/shortest_side.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The faces of rigid bodies at the end of a phase. Contact acts on the border of a body alone. What carries a point
/// and what carries the border differ by what no function of the grid feels: in ground that flows around a rigid body
/// for long, a point beside the border comes to lie past it, feels nothing there and would be left behind inside, with
/// the stiffness of the ground. A point that lies in the rigid body by less than a tenth of a cell is put back onto its
/// face, as GridFaces does at a face of the grid; one that lies deeper has come there in another way.
template <Kinematics K>
class RigidFaces {
  static constexpr int dim = dimensions(K);
  using Finder = TouchFinder<K>;

 public:
  /// first_number, of the points of each body, must outlive this object.
  explicit RigidFaces(const std::vector<int>& first_number) : first_number_(first_number) {}
  /// finder: must outlive this object; placement: that of its rigid body at the end of the phase.
  void add(const Finder& finder, const RigidPlacement<Finder::N>& placement) { all_.push_back({&finder, placement}); }

  /// Puts back points of occupied cell k, which lies at `cell` in the grid of the phase; x: where it takes the points,
  /// (points) along each axis [m]. Several threads may do so for different cells.
  void put_back(const MaterialPoints<dim>& points, std::size_t k, const Grid<dim>& grid,
                const std::array<int, static_cast<std::size_t>(dim)>& cell,
                std::array<std::vector<double>, dim>& x) const {
    if (all_.empty()) return;
    constexpr double most = 0.1, apart = 3;  // [cells]: to be put back by; between two points of a cell by now
    const double side = shortest_side(grid, cell);
    double diagonal = 0;
    for (std::size_t d = 0; d < dim; ++d) {
      const auto& nodes = grid.axes[d].nodes;
      const auto i = static_cast<std::size_t>(cell[d]);
      diagonal = std::hypot(diagonal, nodes[i + 1] - nodes[i]);
    }
    for (const Face& face : all_) {
      const std::size_t begin = points.begin(k);
      if (face.finder->distance(position(begin, x), face.placement) > apart * diagonal) continue;
      for (std::size_t p = begin; p < points.end(k); ++p) {
        if (!face.finder->touches(body_of(first_number_, points.number[p]))) continue;
        const auto at = face.finder->nearest(Finder::position_of(position(p, x)), face.placement);
        const double depth = -at.distance;
        if (!(0 < depth && depth < most * side)) continue;
        for (std::size_t d = 0; d < dim; ++d) x[d][p] += depth * at.normal[static_cast<Eigen::Index>(d)];
      }
    }
  }

 private:
  struct Face {
    const Finder* finder;
    RigidPlacement<Finder::N> placement;
  };
  static Point<dim> position(std::size_t p, const std::array<std::vector<double>, dim>& x) {
    Point<dim> position;
    for (std::size_t d = 0; d < dim; ++d) position[d] = x[d][p];
    return position;
  }

  const std::vector<int>& first_number_;
  std::vector<Face> all_;
};

}  // namespace stillpoint

// Where a border in the plane ends at a face of the grid that it stays at.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cmath>

#include "space/grid/grid.hpp"

namespace stillpoint {

/// A face of the grid at which a border ends and stays: a plane of symmetry, a held face, or the axis.
struct FaceEnd {
  int axis = -1;  // across the face; −1: there is none
  double at = 0;  // its coordinate [m]

  bool is_there() const { return axis >= 0; }
};

/// Whether a face of the grid holds what touches it, for good, in its normal's direction.
inline bool holds_normal(const Problem& problem, Face face) {
  return std::ranges::any_of(problem.supports, [face](const SupportSpec& support) {
    const bool normal = !support.holds_one_component() || support.component == axis_of(face);
    return support.face == face && !support.on_part() && !support.stiffness && normal && support.motion.constant() &&
           support.motion({}, 0) == 0;
  });
}

/// The face of the grid, or the axis, at which a border ends that goes along `along` and through x.
template <Kinematics K>
FaceEnd face_at(const Problem& problem, const Grid<2>& grid, const Point<2>& x, const Point<2>& along) {
  constexpr double rounding = 1e-9, least = 0.3;  // of the grid's length; of the cosine to the face's normal
  for (const Face face : {Face::left, Face::right, Face::bottom, Face::top}) {
    const int axis = axis_of(face);
    const auto d = static_cast<std::size_t>(axis);
    const double at = is_upper(face) ? grid.axes[d].max() : grid.axes[d].min();
    const bool on_axis = K == Kinematics::axisymmetric && face == Face::left && at == 0;
    const bool near = std::abs(x[d] - at) <= rounding * (grid.axes[d].max() - grid.axes[d].min());
    if (near && std::abs(along[d]) > least && (on_axis || holds_normal(problem, face))) return {axis, at};
  }
  return {};
}

}  // namespace stillpoint

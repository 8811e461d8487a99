// The tractions of a scene as pieces of surface of the body's box.
#pragma once

#include <cmath>
#include <numbers>

#include "space/boundary/surface_loads.hpp"

namespace stillpoint {

/// Along a face each cell has three Gauss points, exact to degree 5; they carry the undeformed area,
/// 2 π r ds where axisymmetric.
template <AxisBasis B, Kinematics K>
SurfaceLoads<B, K> make_surface_loads(const Scene& scene, const Grid<dimensions(K)>& grid) {
  constexpr int dim = dimensions(K);
  SurfaceLoads<B, K> loads;
  for (const auto& spec : scene.tractions) {
    const BodySpec& body = scene.bodies.front();
    const std::size_t traction = loads.add_traction({spec.value, spec.pressure});
    const int axis = axis_of(spec.face);
    std::array<double, dim> normal{};
    normal[static_cast<std::size_t>(axis)] = is_upper(spec.face) ? 1 : -1;
    const double face = (is_upper(spec.face) ? body.max : body.min)[static_cast<std::size_t>(axis)];
    if constexpr (dim == 1) {
      loads.add(traction, {face}, normal, body.area);
    } else {
      const auto along = static_cast<std::size_t>(1 - axis);
      const double begin = body.min[along], end = body.max[along];
      const auto& nodes = grid.axes[along].nodes;
      for (std::size_t c = 0; c + 1 < nodes.size(); ++c) {
        const double from = std::max(begin, nodes[c]), to = std::min(end, nodes[c + 1]);
        if (!(to > from)) continue;
        const double middle = (from + to) / 2, half = (to - from) / 2, offset = std::sqrt(0.6);
        for (const auto& [xi, weight] : {std::pair{-offset, 5.0 / 9}, {0.0, 8.0 / 9}, {offset, 5.0 / 9}}) {
          Point<dim> x;
          x[static_cast<std::size_t>(axis)] = face;
          x[along] = middle + half * xi;
          const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
          loads.add(traction, x, normal, half * weight * depth);
        }
      }
    }
  }
  return loads;
}

}  // namespace stillpoint

// Domains at the end of a phase: their corners move with the body, and those that are too wide are halved.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "space/phase/material_point_phase.hpp"
#include "space/points/domain_halving.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::halve_domains() {
  for (;;) {
    const std::vector<int> from = halve_wide_domains(body_.points, grid_);
    if (from.empty()) return;
    refuse_folded_domains();
    take_materials(from);
    motion_since_deformation_ = std::numeric_limits<double>::infinity();  // halves have the deformation of their
                                                                          // corners
  }
}

// Throws SceneError for a folded domain: under a point force one corner may be drawn out alone, until the rest of the
// domain is no convex quadrilateral.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::refuse_folded_domains() const {
  const auto folded = std::ranges::find_if(body_.points.volume, [](double V) { return !(V > 0); });
  if (folded == body_.points.volume.end()) return;
  const auto p = static_cast<std::size_t>(folded - body_.points.volume.begin());
  throw_scene_error(
      "phase",
      fmt::format("the domain of material point {} at ({:.6g}) is stretched over more than a cell, and folded where it "
                  "would be halved; expected a [[traction]] in the place of a force at a point, smaller loads or cells",
                  body_.points.number[p] + 1, fmt::join(body_.points.position(p), ", ")));
}

// Transfers the materials' stored states to the changed set of points.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_materials(const std::vector<int>& from) {
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    const auto begin = static_cast<std::size_t>(body_.points.material_begin[m]);
    body_.materials[m]->take(from, begin, static_cast<std::size_t>(body_.points.material_begin[m + 1]) - begin);
  }
  spare_.reset();
}

// Moves the corners of a domain, x_c += Σ_i N_i(x_c) u_i.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::move_corners(std::size_t k, std::size_t p) {
  const auto cell = grid_.cell_at(body_.points.cell[k]);
  const auto domain = Domain<Dim>::in_grid(body_.points, p, grid_);
  for (int c = 0; c < domain.corners; ++c) {
    const auto at_corner = Basis::evaluate(grid_, cell, domain.x[c]);
    for (int d = 0; d < Dim; ++d) {
      double u_c = 0;
      for (int a = 0; a < per_cell; ++a)
        u_c += at_corner.N[a] * grid_u_[static_cast<std::size_t>(Dim * weights_.function(k, a) + d)];
      body_.points.corner[Dim * c + d][p] += u_c;
    }
  }
}

}  // namespace stillpoint

// Loads by a force per mass at the material points: F_i = Σ_p N_ip m_p b_p.
#pragma once

#include "space/boundary/boundary_condition.hpp"

namespace stillpoint {

/// F += the load on the free degrees of freedom, (n); b(p, i): component i at point p [m/s²].
template <int Dim, class Force>
void add_point_loads(const PhaseParts<Dim>& phase, const Force& b, Vec F) {
  const auto& points = phase.points;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      phase.weights.add_at_functions(
          k, p, [&](int i) { return points.mass[p] * b(p, i); }, phase.dofs, F);
    }
  }
}

/// F_s += the load on the prescribed degrees of freedom, (prescribed).
template <int Dim, class Force>
void add_point_loads_on_supports(const PhaseParts<Dim>& phase, const Force& b, Vec F_s) {
  const auto& points = phase.points;
  const std::size_t n = phase.dofs.size();
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (int a = 0; a < phase.weights.functions_of_cell(); ++a) {
      for (int i = 0; i < Dim; ++i) {
        phase.dofs.for_sources(Dim * phase.weights.function(k, a) + i, [&](int, int dof, double share) {
          if (phase.dofs.is_free(dof)) return;
          typename PointFunctions<Dim>::Numbers N;
          for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
            phase.weights.values(k, p, N);
            F_s[static_cast<std::size_t>(dof) - n] += share * points.mass[p] * b(p, i) * N[a];
          }
        });
      }
    }
  }
}

}  // namespace stillpoint

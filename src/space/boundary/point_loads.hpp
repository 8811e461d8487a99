// Loads by a force per mass at the material points: F_i = Σ_p N_ip m_p b_p.
#pragma once

#include <vector>

#include "space/boundary/boundary_condition.hpp"
#include "space/kernels/corner_sum.hpp"

namespace stillpoint {

/// The load on each function of the grid, (functions × Dim) [N]; b(p, i): component i at point p [m/s²].
template <int Dim, class Force>
std::vector<double> load_on_functions(const PhaseParts<Dim>& phase, const Force& b) {
  const auto& points = phase.points;
  const auto per_cell = static_cast<std::size_t>(phase.weights.functions_of_cell());
  std::vector<double> of_corners(Dim * phase.corner_sum.corners() + CornerSum::slack);
  for (std::size_t k = 0; k < points.cells(); ++k) {
    double* const of_cell = of_corners.data() + Dim * per_cell * k;
    typename PointFunctions<Dim>::Numbers N;
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      phase.weights.values(k, p, N);
      for (std::size_t i = 0; i < Dim; ++i) {
        const double force = points.mass[p] * b(p, static_cast<int>(i));
        for (std::size_t a = 0; a < per_cell; ++a) of_cell[Dim * a + i] += N[a] * force;
      }
    }
  }
  std::vector<double> load(Dim * phase.corner_sum.functions());
  phase.corner_sum.template sum_at_functions<Dim>(of_corners.data(), load.data());
  return load;
}

/// Calls add(dof, share) with each degree of freedom's share of the loads.
template <int Dim, class Force, class Add>
void for_point_loads(const PhaseParts<Dim>& phase, const Force& b, const Add& add) {
  const std::vector<double> load = load_on_functions(phase, b);
  for (std::size_t unknown = 0; unknown < load.size(); ++unknown) {
    if (load[unknown] == 0) continue;
    phase.dofs.for_sources(static_cast<int>(unknown),
                           [&](int, int dof, double share) { add(dof, share * load[unknown]); });
  }
}

/// F += the load on the free degrees of freedom, (n).
template <int Dim, class Force>
void add_point_loads(const PhaseParts<Dim>& phase, const Force& b, Vec F) {
  for_point_loads(phase, b, [&](int dof, double load) {
    if (phase.dofs.is_free(dof)) F[static_cast<std::size_t>(dof)] += load;
  });
}

/// F_s += the load on the prescribed degrees of freedom, (prescribed).
template <int Dim, class Force>
void add_point_loads_on_supports(const PhaseParts<Dim>& phase, const Force& b, Vec F_s) {
  for_point_loads(phase, b, [&](int dof, double load) {
    if (!phase.dofs.is_free(dof)) F_s[static_cast<std::size_t>(dof) - phase.dofs.size()] += load;
  });
}

}  // namespace stillpoint

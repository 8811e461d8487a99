// The null-space stress of a phase, the part of the points' stresses that no function of the grid feels.
#pragma once

#include "space/kernels/point_fit.hpp"
#include "space/phase/law_gradients.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

// Forces are Σ_p V_p σ_p ∇N_ip: a stress that varies from point to point faster than the functions is in the null space
// of that sum, and nothing ever relaxes it [Gritton and Berzins 2017].
template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::null_space_stress(double t, ConstVec u) const {
  constexpr int stresses = stillpoint::stress_components(K);
  using Fit = PointFit<stresses, B, K>;
  spread(t, u, grid_u_);
  const MaterialPoints<Dim>& points = body_.points;
  typename Fit::Values of_points;
  of_points.value.resize(points.size());
  const auto shared = shared_dilatation(grid_u_.data());
  LawGradients<B, K> gradients(body_, weights_, shared, grid_u_.data());
  for_points([&](std::size_t k, std::size_t p, std::size_t) {
    of_points.value[p] = material_of(k).cauchy(gradients.at(k, p), p);
  });
  const auto square = [](const auto& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return sum;
  };
  double missed = 0, all = 0;
  for (std::size_t b = 0; b + 1 < body_.first_number.size(); ++b) {
    of_points.mass.assign(points.size(), 0);
    double volume = 0, of_body = 0;
    for_points([&](std::size_t, std::size_t p, std::size_t) {
      if (points.number[p] < body_.first_number[b] || points.number[p] >= body_.first_number[b + 1]) return;
      of_points.mass[p] = points.volume[p];
      volume += points.volume[p];
      of_body += points.volume[p] * square(of_points.value[p]);
    });
    all += of_body;
    if (!(of_body > 0)) continue;
    const Fit fit(grid_, points, weights_, nodal_force_.corner_sum(), of_points,
                  {.gradient_share = 0, .tolerance = 1e-3 * std::sqrt(of_body / volume), .iterations = 30});
    const std::vector<double> fitted = fit.solve({});
    for_points([&](std::size_t k, std::size_t p, std::size_t) {
      auto off = fit.value(fitted, k, p);
      for (int i = 0; i < stresses; ++i) off[i] -= of_points.value[p][i];
      missed += of_points.mass[p] * square(off);
    });
  }
  return all > 0 ? std::sqrt(missed / all) : 0;
}

}  // namespace stillpoint

#include "output/exact_error.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace stillpoint {
namespace {

// Σ V |a − b|², Σ V |b|² and the largest of each, gathered point by point.
struct Norms {
  double difference = 0, exact = 0, max_difference = 0, max_exact = 0;
  void add(double V, double value, double expected) {
    difference += V * (value - expected) * (value - expected);
    exact += V * expected * expected;
    max_difference = std::max(max_difference, std::abs(value - expected));
    max_exact = std::max(max_exact, std::abs(expected));
  }
  double rel_l2() const { return std::sqrt(difference / exact); }
};

}  // namespace

std::optional<ExactError> exact_error(const Scene& scene, const LagrangianPhase& phase, double t, ConstVec u) {
  if (scene.exact_u.empty()) return std::nullopt;
  const auto dim = static_cast<std::size_t>(phase.dim());
  std::vector<double> displacement(dim * phase.points());
  phase.point_displacement(t, u, displacement);
  std::vector<double> stress(static_cast<std::size_t>(phase.info().stress_components) * phase.points());
  phase.point_stress(t, u, stress);
  const std::vector<double> positions = phase.positions(), volumes = phase.point_data().volumes;
  Norms in_u, in_stress;
  for (std::size_t p = 0; p < phase.points(); ++p) {
    const std::span<const double> x(positions.data() + dim * p, dim);
    const double V = volumes[p];
    for (std::size_t i = 0; i < dim; ++i) in_u.add(V, displacement[dim * p + i], scene.exact_u[i](x, t));
    if (scene.exact_stress)
      in_stress.add(V, stress[static_cast<std::size_t>(phase.info().stress_components) * p],
                    (*scene.exact_stress)(x, t));
  }
  if (in_u.exact == 0) return std::nullopt;
  ExactError error{.u_rel_l2 = in_u.rel_l2(), .u_rel_max = in_u.max_difference / in_u.max_exact, .stress_rel_l2 = {}};
  if (in_stress.exact > 0) error.stress_rel_l2 = in_stress.rel_l2();
  return error;
}

}  // namespace stillpoint

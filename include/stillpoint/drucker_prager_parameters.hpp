#pragma once
#include <stillpoint/scene.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
namespace stillpoint {
enum class Cone { plane_strain, mean, compression, extension };
struct ConeCoefficients {
  double eta, xi, eta_bar;
};
inline ConeCoefficients cone_coefficients(Cone, double phi, double psi) {
  const double s = std::sin(phi * std::numbers::pi / 180), sp = std::sin(psi * std::numbers::pi / 180);
  double eb = 3 * sp / std::sqrt(9 + 3 * sp * sp);
  double r = 1 / (std::sqrt(1 - eb * eb / 3) + eb / 3 * s);
  return {r * s, r * std::cos(phi * std::numbers::pi / 180), eb};
}
struct DruckerPragerParameters {
  double E, nu = 0;
  double phi = 0, psi = 0, c = 0;
  Cone cone = Cone::plane_strain;
  double fluidity = 0, tension = std::numeric_limits<double>::infinity();
  std::optional<double> phi_residual, c_residual;
  double softening_strain = 0;
};
}  // namespace stillpoint

#include "scene/pore_water.hpp"

#include <algorithm>

namespace stillpoint {

// K_u = 2 G (1 + ν_u)/(3 (1 − 2 ν_u)) = K + K_w/n
double water_stiffness(const MaterialSpec& material) {
  if (material.water_modulus) return *material.water_modulus / material.porosity;
  constexpr double nu_u = 0.495;
  const double E = material.parameters.at("E"), nu = material.parameters.at("nu");
  const double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
  return std::max(0.0, 2 * G * (1 + nu_u) / (3 * (1 - 2 * nu_u)) - K);
}

bool has_E_and_nu(const MaterialSpec& material) {
  return material.parameters.contains("E") && material.parameters.contains("nu");
}

// G and K + K_w/n:  ν = (3 K − 2 G)/(2 (3 K + G)),  E = 2 G (1 + ν)
YoungPoisson with_water(const MaterialSpec& material) {
  const double E = material.parameters.at("E"), nu = material.parameters.at("nu");
  if (!material.undrained) return {E, nu};
  const double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu)) + water_stiffness(material);
  const double nu_u = (3 * K - 2 * G) / (2 * (3 * K + G));
  return {2 * G * (1 + nu_u), nu_u};
}

}  // namespace stillpoint

#include <stillpoint/material_laws.hpp>

#include <limits>

namespace stillpoint {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr ParameterInfo youngs_modulus{"E", "Pa", "Young's modulus", 0, infinity, true, 0};
constexpr ParameterInfo poissons_ratio{"nu", "1", "Poisson's ratio", -1, 0.5, false, 0};
// A strongly auxetic neo-Hookean section has no unique lateral stretch in compression.
constexpr ParameterInfo neo_hookean_poissons_ratio{"nu", "1", "Poisson's ratio", -0.2, 0.5, false, 0};
constexpr ParameterInfo density{"rho", "kg/m3", "density", 0, infinity, true, 0};

}  // namespace

const std::vector<LawInfo>& material_laws() {
  static const std::vector<LawInfo> laws = {
      {"linear-elastic",
       "sigma = lambda tr(eps) I + 2 mu eps, small strain",
       "Hooke's law",
       {youngs_modulus, poissons_ratio, density}},
      {"neo-hookean",
       "W = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2, finite strain",
       "Bonet and Wood 2008, eq. 6.27",
       {youngs_modulus, neo_hookean_poissons_ratio, density}},
  };
  return laws;
}

}  // namespace stillpoint

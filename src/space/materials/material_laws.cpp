#include "space/materials/material_laws.hpp"

#include <stillpoint/drucker_prager_cone.hpp>

#include <algorithm>
#include <limits>

#include "base/growing_table.hpp"

namespace stillpoint {
namespace {

constexpr const char* fluidity = "fluidity";

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr ParameterInfo positive(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {name, unit, meaning, 0, infinity, false, true, 0};
}
constexpr ParameterInfo optional(std::string_view name, std::string_view unit, std::string_view meaning, double upper,
                                 double fallback) {
  return {name, unit, meaning, 0, upper, true, false, fallback};
}
constexpr ParameterInfo same_as(std::string_view other, ParameterInfo parameter) {
  parameter.same_as = other;
  parameter.fallback = std::numeric_limits<double>::quiet_NaN();
  return parameter;
}

constexpr ParameterInfo youngs_modulus = positive("E", "Pa", "Young's modulus");
constexpr ParameterInfo poissons_ratio{"nu", "1", "Poisson's ratio", -1, 0.5, false, false, 0};
// A strongly auxetic neo-Hookean section has no unique lateral stretch in compression.
constexpr ParameterInfo neo_hookean_poissons_ratio{"nu", "1", "Poisson's ratio", -0.2, 0.5, false, false, 0};
constexpr ParameterInfo density = positive("rho", "kg/m3", "density");

std::vector<std::string_view> cone_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, cone] : cone_words) names.push_back(name);
  return names;
}

// The laws of this library.
std::vector<LawInfo> built_in() {
  using enum StressState;
  static const std::vector<StressState> all = {uniaxial_stress, uniaxial_strain, plane_strain,
                                               plane_stress,    axisymmetric,    space};
  return {
      {"linear-elastic",
       "sigma = lambda tr(eps) I + 2 mu eps, small strain",
       "Hooke's law",
       all,
       {youngs_modulus, poissons_ratio, density},
       {},
       /*history_dependent=*/false,
       /*finite_strain=*/false},
      {"neo-hookean",
       "W = mu/2 (tr C - 3 - 2 ln J) + lambda/2 (ln J)^2, finite strain",
       "Bonet and Wood 2008, eq. 6.27",
       all,
       {youngs_modulus, neo_hookean_poissons_ratio, density},
       {}},
      {"hencky",
       "W = mu tr(e^2) + lambda/2 (tr e)^2, e = 1/2 ln(F F^T), finite strain",
       "Anand 1979",
       all,
       {youngs_modulus, poissons_ratio, density},
       {}},
      {"drucker-prager",
       "sqrt(J2) + eta p - xi c <= 0, flow by sqrt(J2) + eta_bar p, tension cut-off with a gap, finite strain",
       "de Souza Neto, Peric and Owen 2008, section 8.3",
       {plane_strain, axisymmetric, space},
       {youngs_modulus, poissons_ratio, density, optional("phi", "degrees", "angle of internal friction", 90, 0),
        optional("psi", "degrees", "angle of dilatancy", 90, 0), optional("c", "Pa", "cohesion", infinity, 0),
        optional(fluidity, "1/(Pa s)", "Perzyna's beta; 0: rate-independent", infinity, 0),
        optional("tension", "Pa", "largest mean stress; never above the apex", infinity, infinity),
        same_as("phi", optional("phi_residual", "degrees", "phi after softening", 90, 0)),
        same_as("c", optional("c_residual", "Pa", "cohesion after softening", infinity, 0)),
        optional("softening_strain", "1", "plastic strain of full softening; 0: none", infinity, 0)},
       {{"cone", "match to Mohr-Coulomb", cone_names(), "plane-strain"}},
       /*history_dependent=*/true},
  };
}

GrowingTable<LawInfo>& table() {
  static GrowingTable<LawInfo> laws(built_in());
  return laws;
}

}  // namespace

const std::vector<LawInfo>& material_laws() { return table().rows(); }

// A user-defined law may have a parameter of this name, but has no history.
bool is_viscous(const MaterialSpec& material) {
  const auto law = std::ranges::find(material_laws(), material.law, &LawInfo::name);
  const auto beta = material.parameters.find(fluidity);
  return law != material_laws().end() && law->history_dependent && beta != material.parameters.end() &&
         beta->second > 0;
}

MaterialSpec rate_independent(MaterialSpec material) {
  if (is_viscous(material)) material.parameters[fluidity] = 0;
  return material;
}

void put_law(const LawInfo& about) {
  table().put(about, [&](const LawInfo& other) { return other.name == about.name; });
}

}  // namespace stillpoint

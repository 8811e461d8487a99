#include "study/strength_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plan/catalogue.hpp"

namespace stillpoint {
namespace {

double angle_over(double phi, double factor) {
  constexpr double degree = std::numbers::pi / 180;
  return std::atan(std::tan(phi * degree) / factor) / degree;
}

}  // namespace

bool has_reducible_strength(const MaterialSpec& material) {
  const LawInfo* const law = catalogue().law(material.law);
  return law && law->has_strength;
}

MaterialSpec with_strength_over(MaterialSpec material, double factor) {
  if (!has_reducible_strength(material) || factor == 1) return material;
  const auto change = [&](const char* name, const auto& how) {
    if (const auto found = material.parameters.find(name); found != material.parameters.end())
      found->second = how(found->second);
  };
  for (const char* name : {"c", "c_residual", "tension"})
    change(name, [factor](double value) { return value / factor; });
  for (const char* name : {"phi", "phi_residual"})
    change(name, [factor](double phi) { return angle_over(phi, factor); });
  change("psi", [phi = material.parameters.at("phi")](double psi) { return std::min(psi, phi); });
  for (StrengthRow& row : material.softening) {
    row.c /= factor;
    row.phi = angle_over(row.phi, factor);
    row.psi = std::min(row.psi, row.phi);
  }
  return material;
}

Problem with_strength_over(Problem problem, double factor) {
  for (auto& [name, material] : problem.materials) material = with_strength_over(material, factor);
  return problem;
}

}  // namespace stillpoint

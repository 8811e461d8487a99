// The data of a scene that exact solutions use.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "scene/pore_water.hpp"

namespace stillpoint {

/// The constants of the single material of the bodies, and their stress state.
struct ElasticConstants {
  double E, nu, rho;     // [Pa], [1], [kg/m³]
  double lambda, mu;     // Lamé's [Pa]
  double kappa;          // Kolosov's: 3 − 4ν in plane strain and axisymmetry, (3 − ν)/(1 + ν) in plane stress
  bool is_plane_stress;  // σ_zz = 0, otherwise ε_zz = 0
};

inline const MaterialSpec& material_of(const Problem& problem) {
  return problem.materials.at(problem.bodies.at(0).material);
}

inline ElasticConstants elastic_constants(const Problem& problem) {
  const MaterialSpec& material = material_of(problem);
  const auto [E, nu] = with_water(material);
  const bool is_plane_stress = problem.state == StressState::plane_stress;
  return {.E = E,
          .nu = nu,
          .rho = material.parameters.at("rho"),
          .lambda = E * nu / ((1 + nu) * (1 - 2 * nu)),
          .mu = E / (2 * (1 + nu)),
          .kappa = is_plane_stress ? (3 - nu) / (1 + nu) : 3 - 4 * nu,
          .is_plane_stress = is_plane_stress};
}

/// σ_zz in a plane body.
inline double across(const ElasticConstants& of, double sigma_xx, double sigma_yy) {
  return of.is_plane_stress ? 0 : of.nu * (sigma_xx + sigma_yy);
}

inline double parameter(const Problem& problem, const char* name) { return problem.exact.parameters.at(name); }

/// The fault of an axisymmetric scene that gives a centre x0, y0 off the axis.
inline std::optional<SolutionFault> fault_of_centre(const Problem& problem) {
  if (problem.state != StressState::axisymmetric) return std::nullopt;
  for (const char* key : {"x0", "y0"}) {
    if (parameter(problem, key) != 0)
      return SolutionFault{.key = key, .message = "an axisymmetric scene has its axis at r = 0; leave this out"};
  }
  return std::nullopt;
}

/// The lower and the upper end of all bodies along an axis; empty if they are no boxes or polygons.
inline std::optional<std::pair<double, double>> extent_along(const Problem& problem, std::size_t axis) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  for (const BodySpec& body : problem.bodies) {
    if (!body.file.empty() || body.min.size() <= axis || body.max.size() <= axis) return std::nullopt;
    low = std::min(low, body.min[axis]);
    high = std::max(high, body.max[axis]);
  }
  return std::pair(low, high);
}
/// Whether such an extent is that from `from` to `from + size`.
inline bool reaches(const std::pair<double, double>& extent, double from, double size) {
  constexpr double rounding = 1e-9;
  return std::abs(extent.first - from) <= rounding * size && std::abs(extent.second - from - size) <= rounding * size;
}

// Rows of parameters:
inline ParameterInfo positive_parameter(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {name, unit, meaning, 0, std::numeric_limits<double>::infinity(), false, true, 0};
}
inline ParameterInfo any_parameter(std::string_view name, std::string_view unit, std::string_view meaning,
                                   double fallback = 0) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {name, unit, meaning, -infinity, infinity, false, false, fallback};
}

}  // namespace stillpoint

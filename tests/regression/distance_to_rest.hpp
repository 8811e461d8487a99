// What certified distances are compared with: the equilibrium, and M-norms of the error.
#pragma once

#include <stillpoint/static_solution.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "way_to_rest.hpp"

namespace stillpoint::test {

using Values = std::vector<double>;

inline double mass_norm(const Mass& mass, ConstVec x) {
  Values Mx(x.size());
  mass.apply(x, Mx);
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * Mx[i];
  return std::sqrt(sum);
}
/// ‖a − b‖_M/‖b‖_M
inline double relative_difference(const Mass& mass, ConstVec a, ConstVec b) {
  Values difference(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return mass_norm(mass, difference) / mass_norm(mass, b);
}

/// By Newton's method.
inline Values equilibrium_of(const Scene& scene) {
  const auto phase = make_phase(scene);
  Values u = phase->initial_displacement(0);
  const StaticReport report = newton(*phase, 0, u, {.tolerance = 1e-11});
  INFO(report.reason);
  REQUIRE(report.converged);
  return u;
}

struct Case {
  const char* name;
  std::vector<std::string> overrides{};
};
/// Each linear.
inline const std::vector<Case> linear_scenes = {
    {"chain"},
    {"bar"},
    {"column"},
    {"inclusion", {"constants.contrast=100", "grid.cells=[12, 12]"}},
    {"incompressible"},
    {"footing",
     {"grid.cells=[12, 9]", "material.rock={law='linear-elastic', E=2e7, nu=0.3, rho=1800}",
      "body=[{max=[6, 4], material='rock', state='plane-strain', points_per_cell=4},"
      "{min=[0, 4], max=[1, 4.5], material='block', points_per_cell=4}]"}}};

inline Scene with(const Case& problem, const std::string& strategy, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), problem.overrides.begin(), problem.overrides.end());
  overrides.push_back(override_of(strategy));
  if (strategy == "viscous") overrides.emplace_back("damping.c=critical");
  return scenes::load(problem.name, overrides);
}

}  // namespace stillpoint::test

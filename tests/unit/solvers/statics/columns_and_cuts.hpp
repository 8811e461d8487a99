// What the tests of static solvers share: columns and cuts of soil, and how a report of them is read.
#pragma once

#include <stillpoint/static_solution.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint::test {

constexpr double rho = 2000, g = 9.81, H = 10, weight = rho * g;

inline Scene column(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), "phase.max_motion=none");
  return scenes::load("column", overrides);
}
/// The column under ρ g H = E/2, of a law for large strain.
inline Scene soft_column(const std::string& law, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"material.soil.law=" + law, "constants.E=392400"});
  return column(overrides);
}
/// 10 m × 10 m of cohesive soil behind a vertical cut on the right, on a fixed base.
inline Scene cut(const std::string& strength, const std::string& cells = "10") {
  return column({"material.soil={law='drucker-prager', E=2e7, nu=0.3, rho=2000, " + strength + "}", "grid.max=[10, 10]",
                 "grid.cells=[" + cells + ", " + cells + "]",
                 "support=[{face='bottom'}, {face='left', kind='roller'}]"});
}
inline const std::vector<std::string> large_strain = {"neo-hookean", "hencky"};
inline const std::string stands = "c=4e4, phi=20, ";  // up to 11 m [Taylor 1937]
inline const std::string associated = "psi=20, cone='mean'", non_associated = "psi=0";

struct Solved {
  std::unique_ptr<LagrangianPhase> phase;
  std::vector<double> u;
  StaticReport report;
};
inline Solved solve(const Scene& scene, const NewtonOptions& options = {}, double t = 0) {
  auto phase = make_phase(scene);
  std::vector<double> u(phase->size(), 0.0);
  auto report = newton(*phase, t, u, options);
  return {std::move(phase), std::move(u), std::move(report)};
}

inline double distance(const std::vector<double>& a, ConstVec b) {
  return largest_difference(a, b) / largest_magnitude(b);
}

/// p of |r_k+1| ~ |r_k|^p, from the last three residuals above rounding.
inline double observed_order(std::vector<double> r) {
  constexpr double rounding = 1e-13;
  while (r.size() > 3 && r.back() < rounding) r.pop_back();
  const std::size_t k = r.size() - 3;
  REQUIRE(r[k] < 0.2);
  return std::log(r[k + 2] / r[k + 1]) / std::log(r[k + 1] / r[k]);
}

inline std::string shown(const StaticReport& report) {
  std::string text = report.reason;
  for (const auto& step : report.load_steps) {
    text += "\n  s = " + std::to_string(step.from) + " to " + std::to_string(step.to) + ":";
    for (const double r : step.residuals) {
      char number[32];
      std::snprintf(number, sizeof number, " %.3e", r);
      text += number;
    }
  }
  return text + "\n  cholesky " + std::to_string(report.cholesky_factorisations) + ", lu " +
         std::to_string(report.lu_factorisations) + ", elastic " + std::to_string(report.elastic_iterations) +
         ", forces " + std::to_string(report.force_evaluations) + ", products " +
         std::to_string(report.tangent_products) + ", bytes " + std::to_string(report.factor_bytes) + ", " +
         std::to_string(report.wall_s) + " s";
}

}  // namespace stillpoint::test

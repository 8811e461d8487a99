// What holds for any exact solution, by central differences of fourth order in the undeformed position.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "scenes.hpp"

namespace exact_checks {

using Vector2 = std::array<double, 2>;
using Stress4 = std::array<double, 4>;  // xx, yy, zz, xy

/// A plane scene of one material under [exact]; law: "linear-elastic".
inline stillpoint::Scene scene(const std::string& exact, const std::string& state = "plane-strain",
                               const std::string& law = "linear-elastic", const std::string& nu = "0.3") {
  return scenes::load("block", {"material.rubber={law='" + law + "', E=2.0, nu=" + nu + ", rho=1.5}",
                                "body.state=" + state, "exact=" + exact});
}

inline Vector2 u(const stillpoint::ExactSolution& exact, const Vector2& X, double t = 0) {
  Vector2 value{};
  exact.displacement(X, t, value);
  return value;
}
inline Stress4 stress(const stillpoint::ExactSolution& exact, const Vector2& X, double t = 0) {
  Stress4 value{};
  exact.stress(X, t, value);
  return value;
}

/// ∂f/∂X_axis, by steps h.
inline double slope(const std::function<double(const Vector2&)>& f, const Vector2& X, std::size_t axis, double h) {
  const auto at = [&](double step) {
    Vector2 moved = X;
    moved[axis] += step;
    return f(moved);
  };
  return (at(-2 * h) - 8 * at(-h) + 8 * at(h) - at(2 * h)) / (12 * h);
}

/// ∂u_i/∂X_j at [2 i + j]
inline std::array<double, 4> gradient(const stillpoint::ExactSolution& exact, const Vector2& X, double h,
                                      double t = 0) {
  std::array<double, 4> H{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j)
      H[2 * i + j] = slope([&](const Vector2& x) { return u(exact, x, t)[i]; }, X, j, h);
  }
  return H;
}

/// Hooke's stress of the displacement, of E = 2 and ν.
inline Stress4 hooke(const stillpoint::ExactSolution& exact, const Vector2& X, stillpoint::StressState state, double nu,
                     double h, double t = 0) {
  const double E = 2, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const auto H = gradient(exact, X, h, t);
  const bool is_axisymmetric = state == stillpoint::StressState::axisymmetric;
  double third = is_axisymmetric ? u(exact, X, t)[0] / X[0] : 0;
  if (state == stillpoint::StressState::plane_stress) third = -lambda / (lambda + 2 * mu) * (H[0] + H[3]);
  const double trace = lambda * (H[0] + H[3] + third);
  return {trace + 2 * mu * H[0], trace + 2 * mu * H[3], trace + 2 * mu * third, mu * (H[1] + H[2])};
}

/// div σ along x and y; around an axis with the terms of the hoop stress. It is ∂²u/∂t² ρ, or −ρ b.
inline Vector2 divergence(const stillpoint::ExactSolution& exact, const Vector2& X, bool is_axisymmetric, double h,
                          double t = 0) {
  const auto of = [&](std::size_t component, std::size_t axis) {
    return slope([&](const Vector2& x) { return stress(exact, x, t)[component]; }, X, axis, h);
  };
  Vector2 sum{of(0, 0) + of(3, 1), of(3, 0) + of(1, 1)};
  if (is_axisymmetric) {
    const Stress4 sigma = stress(exact, X, t);
    sum[0] += (sigma[0] - sigma[2]) / X[0];
    sum[1] += sigma[3] / X[0];
  }
  return sum;
}

/// Why such an [exact] is refused; empty if it is not.
inline std::string refusal(const std::string& exact, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"material.rubber={law='linear-elastic', E=2.0, nu=0.3, rho=1.5}",
                                        "exact=" + exact};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return scenes::refusal("block", overrides);
}

}  // namespace exact_checks

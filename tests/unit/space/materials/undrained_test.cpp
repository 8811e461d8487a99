// Saturated ground from which no water flows, beside closed forms of undrained tests.
#include <stillpoint/drucker_prager.hpp>
#include <stillpoint/mohr_coulomb.hpp>
#include <stillpoint/undrained.hpp>

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/history_path.hpp"

namespace stillpoint {
namespace {

using enum StressState;

// A skeleton of K = 10 MPa and G = 4.615 MPa with water of K_w/n = 5500 MPa.
constexpr double water = 2.2e9 / 0.4;

template <StressState S>
struct Saturated {
  MohrCoulombParameters soil{.E = 12e6, .nu = 0.3, .c = 5e3, .phi = 30};
  double stiffness = water;
};

template <StressState S>
struct Law : Undrained<MohrCoulomb<S>> {
  explicit Law(const Saturated<S>& of) : Undrained<MohrCoulomb<S>>(MohrCoulomb<S>(of.soil), of.stiffness) {}
};

template <StressState S>
using SaturatedPath = test::HistoryPath<Law<S>, Saturated<S>>;

template <StressState S>
double pore_pressure(const SaturatedPath<S>& path) {
  return path.now.back();
}

}  // namespace

TEST_CASE("water bears Skempton's share of an isotropic pressure") {
  SaturatedPath<axisymmetric> path({.soil = {.E = 12e6, .nu = 0.3, .c = 1e9}});
  path.go({-1e-5, 0, 0, -1e-5, -1e-5}, 10);
  const Stress<axisymmetric> total = path.stress();
  CHECK(pore_pressure(path) / -total[0] == Approx(0.9981851179673321).epsilon(1e-6));  // the strain's second order
  CHECK(total[1] == Approx(total[0]).epsilon(1e-12));
  CHECK(pore_pressure(path) == Approx(-water * 3 * std::log1p(-1e-5)).epsilon(1e-11));
}

TEST_CASE("undrained shear in the plane ends at s_u = c cos phi + p0 sin phi") {
  SaturatedPath<plane_strain> path({}, {-1e5, -1e5, -1e5, 0});
  path.go({0, 0.05, 0, 0}, 200);
  const Stress<plane_strain> total = path.stress();
  CHECK(std::hypot(total[3], (total[0] - total[1]) / 2) == Approx(54330.12701892218).epsilon(1e-6));
}

TEST_CASE("undrained triaxial compression ends at the strength and the pore pressure of incompressible water") {
  // q = 2 (c cos φ + p₀ sin φ)/(1 − sin φ/3), Δp_w = (q/3 at constant total σ₃); water 1e4 times as stiff as the
  // skeleton
  SaturatedPath<axisymmetric> path({.stiffness = 1e11}, {-1e5, -1e5, -1e5, 0});
  double across = 0;
  for (int k = 1; k <= 40; ++k) {
    const double axial = std::expm1(-0.04 * k / 40);
    const auto at = [&](double rr) { return Gradient<axisymmetric>{rr, 0, 0, axial, rr}; };
    const auto off = [&](double rr) { return path.stress_after(at(rr))[0] + 1e5; };
    double x0 = across, x1 = 1 / std::sqrt(1 + axial) - 1, f0 = off(x0), f1 = off(x1);
    for (int n = 0; n < 50 && f1 != f0; ++n) {
      const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
      x0 = x1, f0 = f1, x1 = x2, f1 = off(x2);
    }
    across = x1;
    path.step(at(across));
  }
  const double q = path.stress()[0] - path.stress()[1];
  CHECK(q == Approx(130392.30484541324).epsilon(1e-3));
  CHECK(pore_pressure(path) == Approx(43464.10161513775).epsilon(2e-3));
}

TEST_CASE("undrained ground that dilates becomes stronger at the rate that its skeleton is compressed at") {
  // dε₁ = −dε₃ = dε, dε₂ = 0, and the plastic parts λ (1 + sin ψ), 0 and −λ (1 − sin ψ), with Lamé's Λ and G:
  //   λ = G dε/(G + sin φ sin ψ (G + Λ)),   d(σ₁ − σ₃) = 4 G (dε − λ)
  const double G = 12e6 / 2.6, Lambda = 12e6 * 0.3 / (1.3 * 0.4);
  for (const double psi : {0.0, 10.0, 30.0}) {
    CAPTURE(psi);
    SaturatedPath<plane_strain> path({.soil = {.E = 12e6, .nu = 0.3, .c = 5e3, .phi = 30, .psi = psi}},
                                     {-1e5, -1e5, -1e5, 0});
    const auto q_at = [&](double strain) {
      path.go({std::expm1(strain), 0, 0, std::expm1(-strain)}, 100);
      return path.stress()[0] - path.stress()[1];
    };
    const double before = q_at(0.01), slope = (q_at(0.012) - before) / 0.002;
    const double factor = 0.5 * std::sin(psi * std::numbers::pi / 180) * (G + Lambda);
    CHECK(slope == Approx(4 * G * factor / (G + factor)).epsilon(1e-6).margin(1));  // Pa, of G = 4.6e6
  }
}

TEMPLATE_TEST_CASE_SIG("undrained moduli are the derivative of the total stress, and the elastic ones are symmetric",
                       "", ((StressState S), S), plane_strain, axisymmetric, space) {
  constexpr int n = gradient_components(S);
  const Law<S> law(Saturated<S>{.stiffness = 5e8});
  Stress<S> sigma{};
  for (int a = 0; a < 3; ++a) sigma[a] = -1e5 - 2e4 * a;
  sigma[3] = 1e4;
  const auto now = law.initial_history(sigma);
  for (const double size : {1e-5, 3e-3, 0.03}) {
    Gradient<S> H{};
    for (int a = 0; a < n; ++a) H[a] = size * (a % 3 == 0 ? 0.3 : a % 2 == 0 ? -0.2 : 0.25);
    const auto P = [&](const Gradient<S>& at) {
      auto next = now;
      return law.first_piola(at, at, 0, next);
    };
    CHECK(checks::relative_distance(law.moduli(H, H, 0, now), checks::differences<S>(P, H)) < 1e-6);  // rounding/d
    const auto A = law.elastic_moduli(H, now);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < a; ++b) CHECK(A[n * a + b] == Approx(A[n * b + a]).margin(1e-3));  // of 1e9
  }
}

TEST_CASE("the pore pressure is that of the volume, on any path and in any number of increments") {
  const Gradient<plane_strain> there = {-0.02, 0.3, -0.1, 0.01};
  const double J = (1 + there[0]) * (1 + there[3]) - there[1] * there[2];
  for (const int steps : {1, 7, 100}) {
    SaturatedPath<plane_strain> path({}, {-1e5, -1e5, -1e5, 0});
    path.go({0.01, 0, 0, -0.02}, steps);
    path.go(there, steps);
    CHECK(pore_pressure(path) == Approx(-water * std::log(J)).epsilon(1e-11));
  }
}

}  // namespace stillpoint

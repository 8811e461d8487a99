// What Drucker–Prager soil bears: in shear, under confinement, at the angle of friction, without it, and softened.
#include <stillpoint/drucker_prager.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/drucker_prager_path.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

// What a specimen shows at the end of a strain along `axis` (component of H) under the lateral stress −1000 on the
// components `lateral`.
struct Mobilised {
  double friction;   // sin φ = |σ₁ − σ₃|/|σ₁ + σ₃|
  double dilatancy;  // sin ψ = (d₁ + d₃)/|d₁ − d₃| of the last increment
};
template <StressState S>
Mobilised mobilised(const DruckerPragerParameters& m, double strain, int axis, const std::vector<int>& lateral) {
  constexpr double confinement = 1000;
  constexpr int steps = 2000;
  Path<S> path(m, {-confinement, -confinement, -confinement, 0});
  Mobilised found{};
  for (int k = 1; k <= steps; ++k) {
    Gradient<S> to = path.H;
    to[axis] = strain * k / steps;
    // the lateral strain, by secants, at which σ_xx is the confinement
    const auto excess = [&](double side) {
      Path<S> trial = path;
      for (const int a : lateral) to[a] = side;
      trial.step(to);
      return trial.law.cauchy(trial.now)[0] + confinement;
    };
    double a = path.H[lateral[0]], b = a - strain / steps / 2, f_a = excess(a);
    for (int i = 0; i < 60 && std::abs(f_a) > 1e-9 * confinement && a != b; ++i) {
      const double f_b = excess(b), next = b - f_b * (b - a) / (f_b - f_a);
      a = b;
      f_a = f_b;
      b = next;
    }
    excess(a);
    const double d1 = (to[0] - path.H[0]) / (1 + to[0]), d3 = (to[axis] - path.H[axis]) / (1 + to[axis]);
    path.step(to);
    const auto s = path.law.cauchy(path.now);
    found = {std::abs((s[1] - s[0]) / (s[1] + s[0])), (d1 + d3) / std::abs(d1 - d3)};
  }
  return found;
}

}  // namespace

TEST_CASE("rate-independent simple shear: tau = min(G gamma, c cos phi - p sin phi)") {
  for (const double phi : {0.0, 30.0}) {
    const double p = -500, c = 400, tau_y = c * std::cos(phi * one_degree) - p * std::sin(phi * one_degree);
    Path<plane_strain> path({.E = ground_E, .nu = ground_nu, .phi = phi, .c = c}, {p, p, p, 0});
    double gamma = 0;
    for (int k = 0; k < 400; ++k) {
      gamma += 1e-6;
      path.step({0, gamma, 0, 0});
      CHECK(path.now[3] ==
            Approx(std::min(ground_G * gamma, tau_y)).epsilon(1e-6));  // rotation: γ²/6, and of σ_xx: γ τ
    }
    CHECK(ground_G * gamma > 2 * tau_y);
    CHECK(path.plastic_strain() == Approx(gamma - tau_y / ground_G).epsilon(1e-3));  // γᵖ is the plastic part of γ
  }
}

TEST_CASE("viscoplastic simple shear: tau = tau_y + rate/beta (1 - exp(-G beta (t - t_y))), first order in dt") {
  const double tau_y = 400, beta = 1e-3, rate = 0.1;  // 1/(G β) = 0.24 ms, rate/β = 100 Pa
  const double t_y = tau_y / (ground_G * rate), end = t_y + 2 / (ground_G * beta);
  const double exact = tau_y + rate / beta * (1 - std::exp(-2.0));
  const auto error = [&](int steps) {
    Path<plane_strain> path({.E = ground_E, .nu = ground_nu, .c = tau_y, .fluidity = beta});
    path.go({0, rate * t_y, 0, 0}, 1, t_y);
    CHECK(path.plastic_strain() == Approx(0).margin(1e-15));
    path.go({0, rate * end, 0, 0}, steps, (end - t_y) / steps);
    return path.now[3] - exact;
  };
  CHECK(std::abs(error(40)) < 0.02 * (exact - tau_y));
  CHECK(error(40) / error(80) == Approx(2).epsilon(0.05));
  CHECK(error(80) / error(160) == Approx(2).epsilon(0.03));
}

TEST_CASE("a viscoplastic point does not flow in no time, and is rate-independent in much time") {
  const Gradient<plane_strain> H = {0.01, 0.03, 0.01, -0.02};
  const DruckerPragerParameters viscous = {
      .E = ground_E, .nu = ground_nu, .phi = 30, .psi = 10, .c = 100, .fluidity = 1e-6};
  auto plastic = viscous, elastic = viscous;
  plastic.fluidity = 0;
  elastic.c = 1e3 * ground_E;
  const Stress<plane_strain> before = {-1e4, -2e4, -1e4, 100};
  Path<plane_strain> none(viscous, before), much(viscous, before), instant(plastic, before), never(elastic, before);
  CHECK(none.step(H, 0) == never.step(H));
  CHECK(none.plastic_strain() == 0);
  CHECK(checks::relative_distance(much.step(H, 1e6), instant.step(H)) < 1e-6);  // 1/(β dt) = 1e-7 G
  // the cut-off holds in no time, too
  Path<plane_strain> apart(viscous);
  apart.step({0.01, 0, 0, 0.01}, 0);
  CHECK(p_of(apart) == Approx(100 / std::tan(30 * one_degree)).epsilon(1e-12));
}

TEST_CASE("an elastic confined compression has K0 = nu/(1 - nu)") {
  Path<plane_strain> plane({.E = ground_E, .nu = ground_nu, .c = 1e3 * ground_E});
  plane.go({0, 0, 0, -0.1}, 10);
  Path<axisymmetric> round({.E = ground_E, .nu = ground_nu, .c = 1e3 * ground_E});
  round.go({0, 0, 0, -0.1, 0}, 10);
  for (const auto& s : {plane.law.cauchy(plane.now), round.law.cauchy(round.now)}) {
    CHECK(s[0] / s[1] == Approx(ground_nu / (1 - ground_nu)).epsilon(1e-12));  // rounding
    CHECK(s[2] == Approx(s[0]).epsilon(1e-12));
  }
}

TEST_CASE("a yielding confined compression has K0 = (1 - eta/sqrt 3)/(1 + 2 eta/sqrt 3)") {
  const double eta = std::sin(20 * one_degree), root = std::sqrt(3.0);
  const double K0 = (1 - eta / root) / (1 + 2 * eta / root);
  REQUIRE(K0 > ground_nu / (1 - ground_nu));  // so that it yields, from the first increment on
  Path<plane_strain> plane({.E = ground_E, .nu = ground_nu, .phi = 20});
  Path<axisymmetric> round({.E = ground_E, .nu = ground_nu, .phi = 20});
  for (const double e : {-1e-5, -1e-3, -0.1}) {
    plane.go({0, 0, 0, e}, 3);
    round.go({0, 0, 0, e, 0}, 3);
    for (const auto& s : {plane.law.cauchy(plane.now), round.law.cauchy(round.now)}) {
      CHECK(s[0] / s[1] == Approx(K0).epsilon(1e-11));  // rounding
      CHECK(s[2] == Approx(s[0]).epsilon(1e-11));
    }
  }
}

TEST_CASE("a biaxial test mobilises phi and psi with the cone matched to plane strain") {
  for (const double phi : {20.0, 35.0}) {
    for (const double psi : {0.0, 10.0, phi}) {
      const auto test =
          mobilised<plane_strain>({.E = ground_E, .nu = ground_nu, .phi = phi, .psi = psi}, -0.03, 3, {0});
      CHECK(test.friction == Approx(std::sin(phi * one_degree)).epsilon(1e-6));  // s_zz has settled as exp(−G γ/τ)
      CHECK(test.dilatancy == Approx(std::sin(psi * one_degree)).margin(1e-4));  // the increment, 3 %/2000
    }
  }
}

TEST_CASE("a triaxial test mobilises phi with the cone of its edge, compressed or extended") {
  const DruckerPragerParameters m = {.E = ground_E, .nu = ground_nu, .phi = 30, .psi = 5};
  auto outer = m, inner = m;
  outer.cone = Cone::compression;
  inner.cone = Cone::extension;
  CHECK(mobilised<axisymmetric>(outer, -0.03, 3, {0, 4}).friction == Approx(0.5).epsilon(1e-6));
  CHECK(mobilised<axisymmetric>(inner, 0.03, 3, {0, 4}).friction == Approx(0.5).epsilon(1e-6));
}

TEST_CASE("without friction there is no apex: any mean stress is elastic, tau is c") {
  Path<plane_strain> path({.E = ground_E, .nu = ground_nu, .c = 1000});
  path.step({0.05, 0, 0, 0.05});
  path.step({0.05, 0.05, 0, 0.05});
  CHECK(p_of(path) > 100 * 1000);
  CHECK(path.gap() == 0);
  CHECK(root_J2_of(path) == Approx(1000).epsilon(1e-12));
}

TEST_CASE("strength falls linearly with the plastic strain to its residual value, and stays there") {
  const double p = -1000, softening_strain = 0.01;
  const DruckerPragerParameters m = {.E = ground_E,
                                     .nu = ground_nu,
                                     .phi = 35,
                                     .c = 500,
                                     .phi_residual = 25,
                                     .c_residual = 100,
                                     .softening_strain = softening_strain};
  const auto strength = [&](double phi, double c) {
    return c * std::cos(phi * one_degree) - p * std::sin(phi * one_degree);
  };
  const double peak = strength(35, 500), residual = strength(25, 100);
  Path<plane_strain, true> path(m, {p, p, p, 0});
  for (int k = 1; k <= 1000; ++k) {
    const double before = path.plastic_strain();
    path.step({0, 2e-5 * k, 0, 0});
    if (path.plastic_strain() == 0) continue;
    const double share = std::min(1.0, before / softening_strain);
    CHECK(root_J2_of(path) == Approx(peak + share * (residual - peak)).epsilon(1e-10));  // rounding
  }
  CHECK(path.plastic_strain() > 1.5 * softening_strain);
  CHECK(path.now[3] == Approx(residual).epsilon(1e-3));  // rotation: τ/G and γ²
}

TEST_CASE("a residual that is not given is that of the peak") {
  const DruckerPragerParameters m = {.E = ground_E, .nu = ground_nu, .phi = 35, .c = 500, .softening_strain = 1e-3};
  Path<plane_strain, true> path(m, {-1e3, -1e3, -1e3, 0});
  path.go({0, 0.01, 0, 0}, 100);
  CHECK(root_J2_of(path) == Approx(500 * std::cos(35 * one_degree) + 1e3 * std::sin(35 * one_degree)).epsilon(1e-12));
}

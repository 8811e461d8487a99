// A Drucker–Prager trial: objective, repeatable, refused where it is no number, and never beyond the cone.
#include <stillpoint/drucker_prager.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "law_checks.hpp"
#include "space/materials/drucker_prager_path.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

static_assert(HistoryLaw<DruckerPrager<plane_strain>> && HistoryLaw<DruckerPrager<axisymmetric>>);

TEST_CASE("elastic simple shear follows Jaumann's rate, tau = G sin gamma, with an error of second order") {
  // σ_xx = G (1 − cos γ) as well
  const double gamma = 1;
  const auto error = [&](int steps) {
    Path<plane_strain> path({.E = ground_E, .nu = ground_nu, .c = 1e3 * ground_E});
    path.go({0, gamma, 0, 0}, steps);
    return std::hypot(path.now[3] - ground_G * std::sin(gamma), path.now[0] - ground_G * (1 - std::cos(gamma)));
  };
  CHECK(error(10) < 1e-3 * ground_G);
  CHECK(error(10) / error(20) == Approx(4).epsilon(0.02));
  CHECK(error(20) / error(40) == Approx(4).epsilon(0.02));
}

TEMPLATE_TEST_CASE_SIG("a rotation by 90 degrees turns the stress exactly, in any number of increments", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  const Stress<S> before = {-3e3, 1e3, -2e3, 2e3};
  for (const int steps : {1, 10, 1000}) {
    Path<S> path({.E = ground_E, .nu = ground_nu, .phi = 30, .c = 1e6}, before);
    Gradient<S> P{};
    for (int k = 1; k <= steps; ++k)
      P = path.step(gradient_part<S>(checks::rotation(90 * one_degree * k / steps) - identity<PlaneTensor>));
    const PlaneTensor Q = checks::rotation(90 * one_degree);
    const Stress<S> exact = checks::turned<S>(Q, before);
    // H = Q − I rounds by 1e-16, which is 1e-16 K of stress an increment
    const double rounding = 1e-16 * ground_K * std::sqrt(steps) + 1e-15 * steps * 3e3;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      CHECK(path.law.cauchy(path.now)[i] == Approx(exact[i]).margin(10 * rounding));
    }
    // P = σ cof Q = Q σ₀ Qᵀ Q
    const auto P_exact = gradient_part<S>(Q * stress_tensor<S>(before));
    for (std::size_t a = 0; a < P.size(); ++a) CHECK(P[a] == Approx(P_exact[a]).margin(10 * rounding));
  }
}

TEMPLATE_TEST_CASE_SIG("P is det(f) sigma f^-T after the increment", "", ((StressState S), S), plane_strain,
                       axisymmetric) {
  Path<S> path({.E = ground_E, .nu = ground_nu, .phi = 30, .psi = 5, .c = 1e4}, {-3e3, -1e3, -2e3, 2e3});
  for (const auto& H : checks::deformations<S>()) {
    const auto P = path.step(H);
    const PlaneTensor f = deformation_gradient<S>(H), sigma = stress_tensor<S>(path.law.cauchy(path.now));
    CHECK(checks::relative_distance(P, gradient_part<S>(determinant(f) * sigma * transpose(inverse(f)))) < 1e-13);
  }
}

TEST_CASE("a trial does not touch what it is made from: twice gives the same bits") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> component(-0.05, 0.05);
  const DruckerPrager<plane_strain> law({.E = ground_E, .phi = 30, .psi = 10, .c = 100, .fluidity = 1e-6});
  const auto committed = law.initial_history({-3e3, -1e3, -2e3, 500});
  for (int i = 0; i < 100; ++i) {
    Gradient<plane_strain> H;
    for (double& component_of_H : H) component_of_H = component(random);
    auto first = committed, second = committed;
    const auto P = law.first_piola(H, H, 1e-3, first);
    CHECK(P == law.first_piola(H, H, 1e-3, second));
    CHECK(first == second);
  }
}

TEMPLATE_TEST_CASE_SIG("a point turned inside out is not a number, so that the trial is refused", "",
                       ((StressState S), S), plane_strain, axisymmetric) {
  const auto refused = [](const Gradient<S>& to) {
    const auto P = Path<S>({.E = ground_E, .phi = 30}, {-1e3, -1e3, -1e3, 0}).step(to);
    return std::isnan(P[0]) && std::isnan(P[1]) && std::isnan(P[2]) && std::isnan(P[3]);
  };
  Gradient<S> H{};
  CHECK_FALSE(refused(H));
  H[0] = -1.1;
  CHECK(refused(H));
  if constexpr (S == axisymmetric) {
    CHECK(refused({0, 0, 0, 0, -1.1}));
    CHECK(refused({-1.1, 0, 0, 0, -1.1}));
  }
}

TEMPLATE_TEST_CASE_SIG("no path leaves the cone or passes the cut-off", "", ((StressState S), S), plane_strain,
                       axisymmetric) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const DruckerPragerParameters& m :
       {DruckerPragerParameters{.E = ground_E, .nu = ground_nu, .phi = 35},
        DruckerPragerParameters{.E = ground_E, .nu = ground_nu, .phi = 35, .psi = 35, .c = 500},
        DruckerPragerParameters{
            .E = ground_E, .nu = ground_nu, .phi = 30, .psi = 10, .c = 500, .cone = Cone::mean, .tension = 200},
        DruckerPragerParameters{.E = ground_E, .nu = ground_nu, .c = 500, .tension = 100}}) {
    const auto cone = ConeCoefficients::from(m.cone, m.phi, m.psi);
    const double p_cut = m.phi > 0 ? std::min(m.tension, m.c / std::tan(m.phi * one_degree)) : m.tension;
    Path<S> path(m);
    Largest worst, highest;
    for (int k = 0; k < 2000; ++k) {
      const double size = std::pow(10.0, -5 + 3 * share(random));
      Gradient<S> to = path.H;
      for (double& component : to) component = 0.99 * component + size * share(random);
      path.step(to);
      worst.take(root_J2_of(path) + cone.eta * p_of(path) - cone.xi * m.c);
      highest.take(p_of(path) - p_cut);
      CHECK(path.gap() >= 0);
    }
    CHECK(worst.value() < 1e-14 * ground_E);  // rounding of a trial of 0.01 E
    CHECK(highest.value() < 1e-14 * ground_E);
  }
}

// Gaps: where soil that bears no tension has been opened, it closes before it presses.
#include <stillpoint/drucker_prager.hpp>

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/drucker_prager_path.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("cohesionless material stretched by 1 % and compressed by 1 % is free of stress, then elastic again") {
  Path<axisymmetric> path({.E = ground_E, .nu = ground_nu, .phi = 35});
  path.go({0.01, 0, 0, 0.01, 0.01}, 10);
  CHECK(path.gap() == Approx(3 * std::log(1.01)).epsilon(1e-6));  // midpoint: (increment)²/12
  path.go({0.004, 0, 0, 0.004, 0.004}, 6);
  CHECK(p_of(path) == 0);
  path.go({0, 0, 0, 0, 0}, 4);
  CHECK(path.gap() == Approx(0).margin(1e-16));
  CHECK(p_of(path) == Approx(0).margin(1e-16 * ground_K));
  path.go({-0.001, 0, 0, -0.001, -0.001}, 10);
  CHECK(p_of(path) == Approx(3 * ground_K * std::log(0.999)).epsilon(1e-6));
  CHECK(root_J2_of(path) == Approx(0).margin(1e-15 * ground_K));
}

TEST_CASE("stretching along one axis, which shears as well, leaves nothing behind either") {
  Path<plane_strain> path({.E = ground_E, .nu = ground_nu, .phi = 35});
  path.go({0, 0, 0, 0.01}, 10);
  CHECK(root_J2_of(path) == Approx(0).margin(1e-15 * ground_E));
  path.go({0, 0, 0, 0}, 10);
  for (const double s : path.law.cauchy(path.now)) CHECK(s == Approx(0).margin(1e-15 * ground_E));
  path.go({0, 0, 0, -1e-3}, 10);  // confined: p is elastic, the shear at yield
  CHECK(p_of(path) == Approx(ground_K * std::log(0.999)).epsilon(1e-6));
  CHECK(root_J2_of(path) == Approx(-std::sin(35 * one_degree) * p_of(path)).epsilon(1e-12));
}

TEST_CASE("a rotation leaves an open gap open") {
  Path<plane_strain> path({.E = ground_E, .nu = ground_nu, .phi = 35});
  path.step({0.01, 0, 0, 0.01});
  const double gap = path.gap();
  const PlaneTensor opened = {1.01, 0, 0, 1.01, 1};
  for (const double angle : {0.3, 1.2, 2.0})
    path.step(gradient_part<plane_strain>(checks::rotation(angle) * opened - identity<PlaneTensor>));
  CHECK(path.gap() == Approx(gap).epsilon(1e-13));
}

TEST_CASE("the cut-off below the apex limits p, and the shear stress there is that of the cone") {
  const DruckerPragerParameters m = {.E = ground_E, .nu = ground_nu, .phi = 30, .c = 1000, .tension = 600};
  Path<plane_strain> path(m);
  path.go({0.01, 0.02, 0, 0}, 50);
  CHECK(p_of(path) == Approx(600).epsilon(1e-12));
  CHECK(root_J2_of(path) == Approx(1000 * std::cos(30 * one_degree) - 600 * 0.5).epsilon(1e-12));
  auto high = m;
  high.tension = 1e9;
  Path<plane_strain> to_apex(high);
  to_apex.go({0.01, 0.02, 0, 0}, 50);
  CHECK(p_of(to_apex) == Approx(1000 / std::tan(30 * one_degree)).epsilon(1e-12));
  CHECK(root_J2_of(to_apex) == Approx(0).margin(1e-15 * ground_E));
}

TEST_CASE("no volume is invented: what is not elastic is gap or dilatancy, on any path") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-1, 1);
  for (const double fluidity : {0.0, 1e-6}) {
    const DruckerPragerParameters m = {.E = ground_E,
                                       .nu = ground_nu,
                                       .phi = 30,
                                       .psi = 20,
                                       .c = 300,
                                       .fluidity = fluidity,
                                       .tension = 200,
                                       .phi_residual = 25,
                                       .c_residual = 0,
                                       .softening_strain = 0.2};
    const double eta_bar = ConeCoefficients::from(m.cone, m.phi, m.psi).eta_bar;
    Path<axisymmetric, true> path(m);
    double volume = 0;  // Σ tr d, on a path without shear
    int open = 0;
    for (int k = 0; k < 1000; ++k) {
      const double size = std::pow(10.0, -4 + 2 * share(random));
      Gradient<axisymmetric> to = path.H;
      for (const int a : {0, 3, 4}) {
        to[a] = 0.99 * to[a] + size * (share(random) + 0.25);  // dilatancy would soon have closed it for good
        volume += (to[a] - path.H[a]) / (1 + (to[a] + path.H[a]) / 2);
      }
      path.step(to, 1e-2);
      open += path.gap() > 0;
      CHECK(p_of(path) / ground_K + path.gap() + eta_bar * path.plastic_strain() ==
            Approx(volume).margin(1e-13));  // rounding
    }
    CAPTURE(open);
    CHECK((open > 100 && open < 900));
  }
}

TEST_CASE("dilatancy takes its room out of an open gap, and presses when that is closed") {
  const DruckerPragerParameters m = {.E = ground_E, .nu = ground_nu, .phi = 30, .psi = 10};
  const double eta_bar = ConeCoefficients::from(m.cone, m.phi, m.psi).eta_bar;
  Path<plane_strain> path(m);
  path.step({0, 0, 0, 1e-3});
  const double gap = path.gap(), closes = gap / eta_bar;
  path.go({0, 0.9 * closes, 0, 1e-3}, 100);
  CHECK(p_of(path) == 0);
  CHECK(path.gap() == Approx(0.1 * gap).margin(2e-3 * gap));  // the block is stretched: 2 d_xy = dγ/(1 + gap)
  path.go({0, 1.1 * closes, 0, 1e-3}, 100);
  CHECK(path.gap() == 0);
  CHECK(p_of(path) < -0.01 * ground_K * gap);
}

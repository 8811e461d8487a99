// A column under its own weight: the closed forms beside quadrature of the law itself, and published settlements.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "unit/exact/exact_checks.hpp"

using namespace stillpoint;
using namespace exact_checks;

namespace {

/// A scene of unit height along x, with E = 1.
Scene line(const std::string& law, const std::string& nu, const std::string& g, const std::string& state) {
  return scenes::load("bar", {"material.bar={law='" + law + "', E=1.0, nu=" + nu + ", rho=1.0}", "body.state=" + state,
                              "grid={min=0, max=1, cells=4, basis='linear'}", "body.max=1", "support=[{at=0.0}]",
                              "force=[]", "probe=[]", "exact={solution='column', height=1, g=" + g + "}"});
}
double top(const Scene& scene) {
  double u = 0;
  exact_solution(scene)->displacement(std::array{1.0}, 0, std::span(&u, 1));
  return u;
}

}  // namespace

TEST_CASE("a column settles as published, by each law") {
  const std::string state = "uniaxial-strain";
  CHECK(top(line("linear-elastic", "0", "1", state)) == Approx(-0.5).epsilon(1e-14));
  // path_independence_test.cpp and problems/ladder: by Lambert's W from elsewhere
  CHECK(1 + top(line("hencky", "0", "0.1", state)) == Approx(0.954422).epsilon(1e-6));
  CHECK(1 + top(line("hencky", "0", "1", state)) == Approx(0.727969).epsilon(1e-6));
  CHECK(1 + top(line("neo-hookean", "0", "1", state)) == Approx(0.647794).epsilon(1e-6));
}

TEST_CASE("a column's strain is that of its weight by the law, at any depth, and its stress the weight above") {
  for (const std::string law : {"linear-elastic", "hencky", "neo-hookean"}) {
    for (const std::string nu : {"-0.1", "0", "0.3", "0.45"}) {
      for (const std::string g : {"1e-9", "0.1", "2"}) {
        CAPTURE(law, nu, g);
        const Scene of = line(law, nu, g, "uniaxial-strain");
        const auto solution = exact_solution(of);
        const double v = std::stod(nu), lambda = v / ((1 + v) * (1 - 2 * v)), mu = 1 / (2 * (1 + v));
        const auto u_at = [&](double x) {
          double u = 0;
          solution->displacement(std::array{x}, 0, std::span(&u, 1));
          return u;
        };
        Largest off, sigma_off;
        for (const double x : {0.05, 0.3, 0.7, 0.95}) {
          const double h = 1e-3, p = std::stod(g) * (1 - x);
          const double strain = (u_at(x - 2 * h) - 8 * u_at(x - h) + 8 * u_at(x + h) - u_at(x + 2 * h)) / (12 * h);
          const double F = 1 + strain, e = std::log1p(strain);
          const double P = law == "linear-elastic" ? (lambda + 2 * mu) * strain
                           : law == "hencky"       ? (lambda + 2 * mu) * e / F
                                                   : mu * (strain + strain / F) + lambda * e / F;
          off.take_magnitude(P / p + 1);
          double sigma = 0;
          solution->stress(std::array{x}, 0, std::span(&sigma, 1));
          sigma_off.take_magnitude(sigma / p + 1);
        }
        CHECK(off.value() < 1e-9);  // h⁴, and the rounding of u over h
        CHECK(sigma_off.value() < 1e-14);
        CHECK(std::abs(u_at(0)) < 1e-15);
      }
    }
  }
}

TEST_CASE("a column in the plane stands along y, and presses sideways as its law says") {
  for (const std::string law : {"linear-elastic", "hencky", "neo-hookean"}) {
    for (const std::string state : {"plane-strain", "axisymmetric"}) {
      CAPTURE(law, state);
      const Scene of = scene("{solution='column', height=1, g=0.3}", state, law);
      const auto solution = exact_solution(of);
      const auto H = gradient(*solution, {0.3, 0.4}, 1e-3);
      const double F = 1 + H[3];
      const double lambda = 2 * 0.3 / (1.3 * 0.4);
      const double lateral = law == "linear-elastic" ? lambda * H[3] : lambda * std::log(F) / F;
      const Stress4 expected{lateral, -1.5 * 0.3 * 0.6, lateral, 0};
      CHECK(largest_difference(stress(*solution, {0.3, 0.4}), expected) < 1e-9);
      CHECK(std::abs(u(*solution, {0.3, 0})[1]) < 1e-15);
      CHECK(u(*solution, {0.3, 1})[0] == 0);
    }
  }
}

TEST_CASE("a bar under its own weight is no confined column, unless nu is 0 or strains are small") {
  CHECK(top(line("linear-elastic", "0.3", "1", "uniaxial-stress")) == Approx(-0.5).epsilon(1e-14));
  CHECK(top(line("hencky", "0", "1", "uniaxial-stress")) == Approx(top(line("hencky", "0", "1", "uniaxial-strain"))));
  CHECK_THROWS_WITH(line("hencky", "0.3", "1", "uniaxial-stress"), Catch::Contains("nu = 0 alone"));
  CHECK_THAT(refusal("{solution='column', height=2, g=1}"),
             Catch::Contains("exact.height") && Catch::Contains("the body reaches from 0 to 1"));
}

// The generalised vortex: rigid circles, the neo-Hookean stress of its gradient, and the load of problems/ladder.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "unit/exact/exact_checks.hpp"

using namespace stillpoint;
using namespace exact_checks;

TEST_CASE("the vortex turns circles as a whole, and nothing outside its ring") {
  const Scene of = scene("{solution='vortex', inner_radius=0.5, outer_radius=1.5, angle=0.4, x0=0.1}", "plane-strain",
                         "neo-hookean");
  const auto solution = exact_solution(of);
  // the middle of the ring turns by the angle itself
  const auto [u_x, u_y] = u(*solution, {1.1, 0});
  CHECK(u_x == Approx(std::cos(0.4) - 1).epsilon(1e-14));
  CHECK(u_y == Approx(std::sin(0.4)).epsilon(1e-14));
  CHECK(u(*solution, {0.1, 0.3}) == Vector2{0, 0});
  CHECK(u(*solution, {1.7, 0.3}) == Vector2{0, 0});
  for (const Vector2 X : {Vector2{0.8, 0.3}, Vector2{-0.9, 0.7}}) {
    const auto H = gradient(*solution, X, 1e-3);
    CHECK((1 + H[0]) * (1 + H[3]) - H[1] * H[2] == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("the vortex of a disc turns its centre by the angle, and nothing beyond its radius") {
  const Scene of = scene("{solution='vortex', outer_radius=1.5, angle=0.4, power=4}", "plane-strain", "neo-hookean");
  const auto solution = exact_solution(of);
  const auto [u_x, u_y] = u(*solution, {1e-9, 0});
  CHECK(u_x == Approx(1e-9 * (std::cos(0.4) - 1)).epsilon(1e-14));
  CHECK(u_y == Approx(1e-9 * std::sin(0.4)).epsilon(1e-14));
  const double angle = 0.4 * std::pow(1 - 1 / 2.25, 4);  // at R = 1
  CHECK(u(*solution, {0, 1})[0] == Approx(-std::sin(angle)).epsilon(1e-14));
  CHECK(u(*solution, {1.1, 1.1}) == Vector2{0, 0});
}

TEST_CASE("the vortex's stress is the neo-Hookean one of its gradient") {
  for (const std::string of_ring :
       {"inner_radius=0.75, power=2", "inner_radius=0.75, power=3", "inner_radius=0.75, power=4.5", "power=4"}) {
    CAPTURE(of_ring);
    const Scene of =
        scene("{solution='vortex', outer_radius=1.25, angle=0.25, " + of_ring + "}", "plane-strain", "neo-hookean");
    const auto solution = exact_solution(of);
    const double mu = 2 / (2 * 1.3);
    for (const Vector2 X : {Vector2{0.8, 0.3}, Vector2{-0.6, 0.8}, Vector2{0.2, -1.1}, Vector2{0.3, 0.1}}) {
      const auto H = gradient(*solution, X, 2e-4);
      const double f_xx = 1 + H[0], f_yy = 1 + H[3];
      // σ = μ (F Fᵀ − I), det F = 1
      const Stress4 expected{mu * (f_xx * f_xx + H[1] * H[1] - 1), mu * (H[2] * H[2] + f_yy * f_yy - 1), 0,
                             mu * (f_xx * H[2] + H[1] * f_yy)};
      CHECK(largest_difference(stress(*solution, X), expected) < 1e-8);  // differences
    }
  }
}

TEST_CASE("the vortex of the ladder is the known one") {
  const Scene known = scenes::load("ladder/vortex");
  Scene formulas = known;
  formulas.exact = {};
  for (const std::string of_turn : {"cos", "sin"}) {
    formulas.exact.u.emplace_back("abs(sqrt(x^2+y^2)-1) < 0.25 ? sqrt(x^2+y^2)*" + of_turn +
                                      "(atan2(y,x)+A*(1-16*(sqrt(x^2+y^2)-1)^2)^n) - " +
                                      (of_turn == "cos" ? "x" : "y") + " : 0",
                                  known.constants);
  }
  const auto one = exact_solution(known), other = exact_solution(formulas);
  for (const Vector2 X : {Vector2{0.8, 0.3}, Vector2{-0.6, 0.8}, Vector2{0.2, -1.1}, Vector2{0.3, 0.1}})
    CHECK(largest_difference(u(*one, X), u(*other, X)) < 1e-15);
}

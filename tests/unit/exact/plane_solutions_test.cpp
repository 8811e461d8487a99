// Lamé's cylinder, Kirsch's hole and a strip load: in equilibrium, compatible by Hooke's law, right at their borders.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "unit/exact/exact_checks.hpp"

using namespace stillpoint;
using namespace exact_checks;

namespace {

struct Case {
  std::string exact, state;
  std::vector<Vector2> positions;
};

const std::vector<Vector2> around = {{1.1, 0.3}, {0.4, 1.3}, {-1.5, 0.2}, {-0.7, -1.2}, {1.2, -1.3}};

std::vector<Case> cases() {
  const std::string cylinder = "{solution='lame-cylinder', inner_radius=1, outer_radius=2, inner_pressure=0.2, ";
  const std::string hole = "{solution='kirsch', radius=1, tension_x=0.3, tension_y=-0.1, x0=0.05, y0=-0.02}";
  const std::string strip = "{solution='strip-load', pressure=0.3, half_width=0.5, fixed_depth=4, x0=0.1, surface=1}";
  const std::vector<Vector2> below = {{0.1, 0.4}, {1.3, 0.7}, {-2, -3}, {0.8, 0.5}, {4, 0.5}, {-3, 0.9}};
  return {{cylinder + "outer_pressure=0.05, x0=0.02}", "plane-strain", around},
          {cylinder + "outer_pressure=0.05, y0=0.1}", "plane-stress", around},
          {cylinder + "outer_pressure=-0.03}", "axisymmetric", {{1.1, 0.3}, {1.9, 0.7}}},
          {hole, "plane-strain", around},
          {hole, "plane-stress", around},
          {strip, "plane-strain", below},
          {strip, "plane-stress", below}};
}

}  // namespace

TEST_CASE("stresses of known solutions are in equilibrium, and Hooke's of their displacements") {
  for (const auto& [exact, state, positions] : cases()) {
    CAPTURE(exact, state);
    const Scene of = scene(exact, state);
    const auto solution = exact_solution(of);
    Largest imbalance, off;
    for (const Vector2& X : positions) {
      for (const double along : divergence(*solution, X, state == "axisymmetric", 1e-3))
        imbalance.take_magnitude(along);
      const Stress4 sigma = stress(*solution, X), expected = hooke(*solution, X, of.state, 0.3, 1e-3);
      off.take(largest_difference(sigma, expected));
    }
    CHECK(imbalance.value() < 1e-9);  // of stresses of about 0.2 that vary over 1: h⁴ and rounding/h
    CHECK(off.value() < 1e-9);
  }
}

TEST_CASE("Lamé's cylinder bears its pressures, and its hoop stress inside is p (b² + a²)/(b² − a²)") {
  const Scene of = scene("{solution='lame-cylinder', inner_radius=1, outer_radius=2, inner_pressure=0.3}");
  const auto solution = exact_solution(of);
  CHECK(stress(*solution, {1, 0})[0] == Approx(-0.3).epsilon(1e-14));
  CHECK(stress(*solution, {1, 0})[1] == Approx(0.3 * 5 / 3).epsilon(1e-14));
  CHECK(stress(*solution, {0, 1})[0] == Approx(0.3 * 5 / 3).epsilon(1e-14));
  CHECK(std::abs(stress(*solution, {2, 0})[0]) < 1e-15);
  // the formulas of problems/cylinder.toml, written by hand
  const Scene cylinder = scenes::load("cylinder");
  const Scene known = scenes::load("cylinder", {"exact={solution='lame-cylinder', inner_radius='a', outer_radius='b', "
                                                "inner_pressure='p'}"});
  const auto by_formulas = exact_solution(cylinder), by_name = exact_solution(known);
  for (const double r : {1.0, 1.3, 2.0}) {
    CHECK(u(*by_name, {r, 0.1})[0] == Approx(u(*by_formulas, {r, 0.1})[0]).epsilon(1e-13));
    CHECK(largest_difference(stress(*by_name, {r, 0.1}), stress(*by_formulas, {r, 0.1})) < 1e-22);  // of 1e-9
  }
}

TEST_CASE("Kirsch's hole is free of traction, concentrates a tension threefold, and is not felt far away") {
  const Scene of = scene("{solution='kirsch', radius=0.5, tension_x=0.2}");
  const auto solution = exact_solution(of);
  CHECK(stress(*solution, {0, 0.5})[0] == Approx(0.6).epsilon(1e-14));   // 3 S at the top
  CHECK(stress(*solution, {0.5, 0})[1] == Approx(-0.2).epsilon(1e-14));  // −S at the side
  Largest traction;
  for (const double angle : {0.1, 0.7, 1.9, 4.0}) {
    const double n_x = std::cos(angle), n_y = std::sin(angle);
    const Stress4 sigma = stress(*solution, {0.5 * n_x, 0.5 * n_y});
    traction.take_magnitude(sigma[0] * n_x + sigma[3] * n_y);
    traction.take_magnitude(sigma[3] * n_x + sigma[1] * n_y);
  }
  CHECK(traction.value() < 1e-15);
  const Stress4 far = stress(*solution, {3e6, 4e6});
  CHECK(far[0] == Approx(0.2).epsilon(1e-12));
  CHECK(std::abs(far[1]) + std::abs(far[3]) < 1e-12);
}

TEST_CASE("a strip load presses on its strip alone, and spreads with depth as Boussinesq's influence factors say") {
  const Scene of = scene("{solution='strip-load', pressure=1, half_width=1, fixed_depth=5}");
  const auto solution = exact_solution(of);
  CHECK(stress(*solution, {0.5, 0})[1] == Approx(-1).epsilon(1e-14));
  CHECK(std::abs(stress(*solution, {1.5, 0})[1]) < 1e-15);
  CHECK(std::abs(stress(*solution, {0.5, 0})[3]) + std::abs(stress(*solution, {-2, 0})[3]) < 1e-15);
  // Das, Advanced Soil Mechanics, table 3.3: σ_z/q under the middle at z/B = 1/2, 1, 2 (B the half width 2, 1, 1/2)
  CHECK(stress(*solution, {0, -0.5})[1] == Approx(-0.959).margin(6e-4));
  CHECK(stress(*solution, {0, -1})[1] == Approx(-0.818).margin(6e-4));
  CHECK(stress(*solution, {0, -2})[1] == Approx(-0.550).margin(6e-4));
  CHECK(std::abs(u(*solution, {0, -5})[1]) < 1e-15);
  CHECK(std::abs(u(*solution, {0, -5})[0]) < 1e-15);
  CHECK(u(*solution, {0, 0})[1] < -0.1);          // the middle settles
  CHECK(std::isfinite(u(*solution, {1, 0})[1]));  // at the end of the strip, where the stress jumps
  CHECK(std::isfinite(stress(*solution, {1, 0})[1]));
  CHECK(u(*solution, {1.7, -1})[0] == Approx(-u(*solution, {-1.7, -1})[0]).epsilon(1e-12));
  CHECK(u(*solution, {1.7, -1})[1] == Approx(u(*solution, {-1.7, -1})[1]).epsilon(1e-12));
}

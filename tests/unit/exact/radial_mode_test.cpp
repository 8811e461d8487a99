// Radial modes: the equation of motion, Hooke's law, the edge, and the roots that tables have.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "unit/exact/exact_checks.hpp"

using namespace stillpoint;
using namespace exact_checks;

namespace {

/// The k R of a mode, by its period: u(t) = cos(ω t) u(0), ω = (k R) c/R.
double wave_number(const ExactSolution& solution, double c, double R) {
  const double h = 1e-3, at_rest = u(solution, {R / 3, 0}, 0)[0];
  // cos(ω h) − 1 = −2 sin²(ω h/2), by four steps for the digits
  const double ratio = u(solution, {R / 3, 0}, 40 * h)[0] / at_rest;
  return std::acos(ratio) / (40 * h) * R / c;
}

}  // namespace

TEST_CASE("a radial mode obeys the equation of motion, and its stress is Hooke's") {
  for (const std::string state : {"plane-strain", "plane-stress", "axisymmetric"}) {
    for (const std::string edge : {"free", "held"}) {
      for (const std::string mode : {"1", "3"}) {
        CAPTURE(state, edge, mode);
        const Scene of =
            scene("{solution='radial-mode', radius=1.5, amplitude=0.1, mode=" + mode + ", edge='" + edge + "'}", state);
        const auto solution = exact_solution(of);
        Largest motion, off;
        for (const Vector2 X : {Vector2{0.8, 0.3}, Vector2{0.2, 1.1}, Vector2{1.2, -0.4}}) {
          const double t = 0.3, h = 2e-3;
          const Vector2 force = divergence(*solution, X, state == "axisymmetric", 2e-3, t);
          for (std::size_t i = 0; i < 2; ++i) {
            const auto at = [&](double step) { return u(*solution, X, t + step)[i]; };
            const double a = (16 * (at(h) + at(-h)) - (at(2 * h) + at(-2 * h)) - 30 * at(0)) / (12 * h * h);
            motion.take_magnitude(force[i] - 1.5 * a);
          }
          off.take(largest_difference(stress(*solution, X, t), hooke(*solution, X, of.state, 0.3, 2e-3, t)));
        }
        CHECK(motion.value() < 1e-7);  // of 10, by differences
        CHECK(off.value() < 1e-8);     // of 1
        if (edge == "free") {
          CHECK(std::abs(stress(*solution, {1.5, 0}, 0)[0]) < 1e-14);
        } else {
          CHECK(std::abs(u(*solution, {1.5, 0}, 0)[0]) < 1e-15);
        }
      }
    }
  }
}

TEST_CASE("radial modes have the wave numbers of the tables") {
  // Leissa 1969 and Love: k R of a free disc in plane stress with nu = 0.3 are 2.0489, 5.3894, 8.5719; held, J_1's
  // zeros
  const double c = std::sqrt(2 / (1.5 * (1 - 0.09)));
  const auto k = [&](const std::string& keys) {
    const Scene of = scene("{solution='radial-mode', radius=1.5, amplitude=0.1, " + keys + "}", "plane-stress");
    return wave_number(*exact_solution(of), c, 1.5);
  };
  CHECK(k("mode=1") == Approx(2.0489).margin(1e-4));
  CHECK(k("mode=2") == Approx(5.3894).margin(2e-4));
  CHECK(k("mode=3") == Approx(8.5719).margin(2e-4));
  CHECK(k("mode=1, edge='held'") == Approx(3.831705970207512).epsilon(1e-9));
  CHECK(k("mode=2, edge='held'") == Approx(7.015586669815619).epsilon(1e-9));
}

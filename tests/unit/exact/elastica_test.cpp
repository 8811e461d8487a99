// The elastica beside published tables and its own differential equation.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "unit/exact/exact_checks.hpp"

using namespace stillpoint;
using namespace exact_checks;

namespace {

// E I = 2 · depth³/12 in plane stress; L = 3
Scene beam(double load_over_EI_by_L2, const std::string& nu = "0.3") {
  const double depth = 0.2, EI = 2 * depth * depth * depth / 12;
  return scene(fmt::format("{{solution='elastica', length=3, depth={}, load={:.17g}, x0=1, y0=-0.5}}", depth,
                           load_over_EI_by_L2 * EI / 9),
               "plane-stress", "linear-elastic", nu);
}

}  // namespace

TEST_CASE("the elastica's tip is where Mattiasson's table has it") {
  // Mattiasson 1981, Int. J. Numer. Meth. Eng. 17:145-153, table I: P L²/(E I), w/L, u/L
  const double table[][3] = {{0.2, 0.06636, 0.00265},
                             {1, 0.30172, 0.05643},
                             {2, 0.49346, 0.16064},
                             {5, 0.71379, 0.38763},
                             {10, 0.81061, 0.55500}};
  for (const auto& [load, w, back] : table) {
    CAPTURE(load);
    const Scene of = beam(load);
    const auto [u_x, u_y] = u(*exact_solution(of), {4, -0.5});
    CHECK(-u_y / 3 == Approx(w).margin(6e-6));
    CHECK(-u_x / 3 == Approx(back).margin(6e-6));
  }
}

TEST_CASE("under a small load the elastica is the beam of linear theory") {
  for (const double load : {1e-2, 1e-3}) {
    CAPTURE(load);
    const Scene of = beam(load);
    const auto solution = exact_solution(of);
    for (const double s : {0.0, 0.9, 1.8, 3.0}) {
      const double w = load / 9 * s * s * (9 - s) / 6;  // P s² (3L − s)/(6 E I)
      CHECK(-u(*solution, {1 + s, -0.5})[1] == Approx(w).epsilon(load * load).margin(1e-12));
    }
  }
}

TEST_CASE("the elastica bends as its moment says, keeps its length, and turns its sections") {
  for (const double load : {0.5, 5.0, 50.0}) {
    CAPTURE(load);
    const Scene of = beam(load);
    const auto solution = exact_solution(of);
    const double h = 1e-3;
    const auto tangent = [&](double s) {  // of the deformed axis
      const auto H = gradient(*solution, {1 + s, -0.5}, h);
      return Vector2{1 + H[0], H[2]};
    };
    const double tip = 3 + u(*solution, {4, -0.5})[0];
    Largest length, moment, section;
    for (const double s : {0.2, 1.0, 2.0, 2.8}) {
      const auto [c, minus_sin] = tangent(s);
      length.take_magnitude(std::hypot(c, minus_sin) - 1);
      const auto angle = [&](double at) { return std::atan2(-tangent(at)[1], tangent(at)[0]); };
      const double curvature = (angle(s - 2 * h) - 8 * angle(s - h) + 8 * angle(s + h) - angle(s + 2 * h)) / (12 * h);
      moment.take_magnitude(curvature / (load / 9 * (tip - s - u(*solution, {1 + s, -0.5})[0])) - 1);
      // ∂u/∂η = (sin θ, cos θ − 1)
      const auto H = gradient(*solution, {1 + s, -0.45}, h);
      section.take_magnitude(H[1] + minus_sin);
      section.take_magnitude(1 + H[3] - c);
    }
    CHECK(length.value() < 1e-9);  // differences over h
    CHECK(moment.value() < 1e-6);  // differences of differences
    CHECK(section.value() < 1e-9);
    CHECK(std::abs(u(*solution, {1, -0.5})[0]) + std::abs(u(*solution, {1, -0.5})[1]) < 1e-14);
  }
}

TEST_CASE("in plane strain a beam is stiffer by 1/(1 - nu²), and a load beyond what is computed is refused") {
  const std::string exact = "{solution='elastica', length=3, depth=0.2, load=1e-6}";
  const Scene stress = scene(exact, "plane-stress"), strain = scene(exact, "plane-strain");
  CHECK(u(*exact_solution(strain), {3, 0})[1] ==
        Approx((1 - 0.09) * u(*exact_solution(stress), {3, 0})[1]).epsilon(1e-6));
  CHECK_THAT(refusal("{solution='elastica', length=3, depth=0.2, load=1}"),
             Catch::Contains("exact.load") && Catch::Contains("E I/L^2"));
}

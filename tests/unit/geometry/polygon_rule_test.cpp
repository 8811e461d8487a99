#include "geometry/polygon_rule.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "largest.hpp"

using namespace stillpoint;

namespace {

constexpr int highest = 9;

double factorial(int n) { return std::tgamma(n + 1.0); }
double binomial(int n, int k) { return std::round(factorial(n) / (factorial(k) * factorial(n - k))); }

/// ∫ x^a y^b over a polygon by Green's theorem, in closed form edge by edge [Steger 1996]; clockwise negative.
double moment(const Polygon& polygon, int a, int b) {
  double sum = 0;
  for (std::size_t e = 0; e < polygon.size(); ++e) {
    const auto [x0, y0] = polygon[e];
    const auto [x1, y1] = polygon[(e + 1) % polygon.size()];
    double of_edge = 0;
    for (int k = 0; k <= a; ++k) {
      for (int l = 0; l <= b; ++l)
        of_edge += binomial(k + l, l) * binomial(a + b - k - l, b - l) * std::pow(x1, k) * std::pow(x0, a - k) *
                   std::pow(y1, l) * std::pow(y0, b - l);
    }
    sum += (x0 * y1 - x1 * y0) * of_edge;
  }
  return sum / ((a + b + 2) * (a + b + 1) * binomial(a + b, a));
}

double by_rule(const PlaneRule& rule, int a, int b) {
  double sum = 0;
  for (std::size_t q = 0; q < rule.x.size(); ++q)
    sum += rule.share[q] * std::pow(rule.x[q][0], a) * std::pow(rule.x[q][1], b);
  return sum;
}

/// Of the rule of each degree, the largest error of a mean that it promises.
double largest_error(const Polygon& polygon, double area, const auto& exact_moment) {
  Largest error;
  for (int degree = 0; degree <= highest; ++degree) {
    const PlaneRule rule = polygon_rule(polygon, degree);
    for (int a = 0; a <= degree; ++a) {
      for (int b = 0; a + b <= degree; ++b) error.take_magnitude(by_rule(rule, a, b) - exact_moment(a, b) / area);
    }
  }
  return error.value();
}

/// ∫ x^a y^b over a box.
double of_box(double x0, double x1, double y0, double y1, int a, int b) {
  return (std::pow(x1, a + 1) - std::pow(x0, a + 1)) / (a + 1) * (std::pow(y1, b + 1) - std::pow(y0, b + 1)) / (b + 1);
}

Polygon star() {
  Polygon star;
  for (int k = 0; k < 14; ++k) {
    const double angle = 2 * std::numbers::pi * k / 14 + 0.1, r = k % 2 == 0 ? 0.9 : 0.3;
    star.push_back({0.4 + r * std::cos(angle), 0.6 + r * std::sin(angle)});
  }
  return star;
}

}  // namespace

TEST_CASE("moments of a triangle are a! b!/(a + b + 2)!") {
  for (const Polygon& triangle : {Polygon{{0, 0}, {1, 0}, {0, 1}}, Polygon{{0, 1}, {1, 0}, {0, 0}}}) {
    CHECK(largest_error(triangle, 0.5,
                        [](int a, int b) { return factorial(a) * factorial(b) / factorial(a + b + 2); }) < 1e-15);
  }
}

TEST_CASE("moments of an L are those of its two boxes") {
  const Polygon l = {{0, 0}, {1, 0}, {1, 0.25}, {0.5, 0.25}, {0.5, 1}, {0, 1}};
  CHECK(largest_error(l, 0.625,
                      [](int a, int b) { return of_box(0, 0.5, 0, 1, a, b) + of_box(0.5, 1, 0, 0.25, a, b); }) < 1e-15);
}

TEST_CASE("moments of a sliver are exact beside its area") {
  for (const double width : {1e-2, 1e-4, 1e-6}) {
    CAPTURE(width);
    const auto upright = [&](int a, int b) { return of_box(0, width, 0, 1, a, b); };
    CHECK(largest_error({{0, 0}, {width, 0}, {width, 1}, {0, 1}}, width, upright) < 1e-15);
    // Askew its width is a difference, and has a relative error of rounding/width.
    const Polygon askew = {{0, 0}, {1, 0.9}, {1, 0.9 + width}, {0, width}};
    CHECK(largest_error(askew, width, [&](int a, int b) { return moment(askew, a, b); }) < 1e-15 / width);
  }
}

TEST_CASE("moments of a part that falls into several are those of all of them, though borders join them") {
  // The arms of a horseshoe reach into the square from the left.
  const Polygon horseshoe = {{-2, 0.1}, {0.8, 0.1}, {0.8, 0.3}, {-1, 0.3},
                             {-1, 0.6}, {0.5, 0.6}, {0.5, 0.9}, {-2, 0.9}};
  const auto of_arms = [](int a, int b) { return of_box(0, 0.8, 0.1, 0.3, a, b) + of_box(0, 0.5, 0.6, 0.9, a, b); };
  const auto turned = [&](int a, int b) { return of_arms(b, a); };
  Polygon upright;
  for (const auto& [x, y] : horseshoe) upright.push_back({y, x});
  CHECK(largest_error(clipped_to_unit_square(horseshoe), 0.31, of_arms) < 1e-15);
  CHECK(largest_error(clipped_to_unit_square(upright), 0.31, turned) < 1e-15);  // joined along y = 0, both ways
  // and all but one of a star's points, cut off
  const Polygon part = clipped_to_unit_square(star());
  CHECK(largest_error(part, signed_area(part), [&](int a, int b) { return moment(part, a, b); }) < 1e-14);
}

TEST_CASE("every point of a rule lies inside, with a positive share") {
  for (const Polygon& part : {star(), clipped_to_unit_square(star())}) {
    const PlaneRule rule = polygon_rule(part, highest);
    for (std::size_t q = 0; q < rule.x.size(); ++q) {
      CHECK(contains(part, rule.x[q]));
      CHECK(rule.share[q] > 0);
    }
  }
}

// Rigid polygons: sharp and rounded, convex and not, and with their mirror image.
#include "geometry/polygon_shape.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/simple_shapes.hpp"
#include "shape_checks.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

const Polygon kL = {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
const std::vector<Vector2d> kConvexCornersOfL = {{-1, -1}, {1, -1}, {1, 0}, {0, 1}, {-1, 1}};
// Straight corners on an oblique edge, off which rounding puts them, and a corner that is straight to 1e-8.
const Polygon kObliqueSquare = {
    {0, 0}, {0.3, 0.1}, {0.6, 0.2}, {0.75, 0.25}, {0.5, 1.0}, {0.125 + 1e-9, 0.875 + 1e-9}, {-0.25, 0.75}};

Polygon star(int points) {
  Polygon polygon;
  for (int k = 0; k < 2 * points; ++k) {
    const double angle = pi * k / points + 0.1, r = k % 2 == 0 ? 1 : 0.4;
    polygon.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return polygon;
}

auto inside_of(const Polygon& polygon) {
  return [&polygon](const Vector2d& x) { return contains(polygon, {x[0], x[1]}); };
}

/// The distance to the border by brute force: that to positions on it that are `spacing` apart, at most.
double distance_by_brute_force(const Polygon& polygon, const Vector2d& x, double spacing) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d a(polygon[k].data()), b(polygon[(k + 1) % polygon.size()].data());
    const int parts = static_cast<int>(std::ceil((b - a).norm() / spacing));
    for (int i = 0; i <= parts; ++i) least = std::min(least, (x - a - (b - a) * i / parts).norm());
  }
  return least;
}

}  // namespace

TEST_CASE("a polygon, convex or not, either way round, has the signed distance of its border") {
  for (const Polygon& polygon : {kL, star(5), kObliqueSquare, Polygon{{-1, -0.9}, {1.1, -0.8}, {0.2, 1}}}) {
    check_shape(*polygon_shape(polygon), 1.5, inside_of(polygon));
    check_signed_distance(*polygon_shape({polygon.rbegin(), polygon.rend()}), 1.5, inside_of(polygon));
  }
}

TEST_CASE("the distance from a star is that by brute force to half the spacing of its samples") {
  constexpr double spacing = 1e-3;
  const auto shape = polygon_shape(star(7));
  Largest above, below;
  for (const Vector2d& x : positions_by_chance<2>(300, 1.5)) {
    const double excess = distance_by_brute_force(star(7), x, spacing) - std::abs(shape->nearest(x).distance);
    above.take(excess);
    below.take(-excess);
  }
  CHECK(above.value() <= spacing / 2);
  CHECK(below.value() < 1e-15);
}

TEST_CASE("rounding cuts off convex corners and leaves a reflex one sharp") {
  constexpr double r = 0.3;
  const auto shape = polygon_shape(kL, r);
  check_shape(*shape, 1.5, [&](const Vector2d& x) {
    const bool beyond_an_arc = std::ranges::any_of(kConvexCornersOfL, [&](const Vector2d& corner) {
      const Vector2d inwards((corner - Vector2d(-0.5, -0.5)).array().sign());
      const Vector2d centre = corner - r * inwards, offset = (x - centre).cwiseProduct(inwards);
      return offset.minCoeff() > 0 && offset.norm() > r;
    });
    return contains(kL, {x[0], x[1]}) && !beyond_an_arc;
  });
  for (const Vector2d& corner : kConvexCornersOfL)
    CHECK(shape->nearest(corner).distance == Approx(r * (std::sqrt(2) - 1)).epsilon(1e-13));
  CHECK(shape->nearest({0, 0}).distance == 0);
  CHECK(shape->nearest({-0.3, -0.4}).distance == Approx(-0.5).epsilon(1e-14));  // of the reflex corner
  CHECK(shape->nearest({-0.3, -0.4}).normal.isApprox(Vector2d(0.6, 0.8), 1e-14));
}

TEST_CASE("a rounded square is the rounded box, and the largest rounding makes it a disc") {
  const Polygon square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const double r : {0.0, 0.4, 1.0}) {
    const auto polygon = polygon_shape(square, r), exact = box<2>({-1, -1}, {1, 1}, r);
    Largest off;
    for (const Vector2d& x : positions_by_chance<2>(500, 2))
      off.take_magnitude(polygon->nearest(x).distance - exact->nearest(x).distance);
    CHECK(off.value() < 1e-15);
  }
}

TEST_CASE("a position beside a straight corner is beside the edge, inside and outside, without curvature") {
  const auto shape = polygon_shape(kObliqueSquare);
  const Vector2d normal = Vector2d(0.1, -0.3).normalized();
  for (std::size_t k = 1; k < 3; ++k) {
    for (const double distance : {-0.1, -1e-3, 1e-3, 0.2, 5.0}) {
      const Nearest<2> here = shape->nearest(Vector2d(kObliqueSquare[k].data()) + distance * normal);
      CHECK(here.distance == Approx(distance).epsilon(1e-12));
      CHECK(here.normal.isApprox(normal, 1e-14));
      CHECK(here.hessian.isZero(0));
    }
  }
}

TEST_CASE("beside the end of an edge, at a corner or an arc, phi is the distance along the normal, near and far") {
  constexpr int n = 7;
  std::vector<Vector2d> corners;
  for (int k = 0; k <= n; ++k) corners.emplace_back(std::cos(2 * pi * k / n + 0.1), std::sin(2 * pi * k / n + 0.1));
  Polygon heptagon;
  for (std::size_t k = 0; k < n; ++k) heptagon.push_back({corners[k].x(), corners[k].y()});
  Largest off;
  for (const double r : {0.0, 0.1}) {
    const auto shape = polygon_shape(heptagon, r);
    for (std::size_t k = 0; k < n; ++k) {
      const Vector2d along = (corners[k + 1] - corners[k]).normalized(), normal(along.y(), -along.x());
      const Vector2d end = corners[k] + r * std::tan(pi / n) * along;
      for (double distance = 1e-3; distance < 1e6; distance *= 1.7)
        off.take_magnitude(shape->nearest(end + distance * normal).distance / distance - 1);
    }
  }
  CHECK(off.value() < 1e-11);
}

TEST_CASE("on a corner itself phi is 0 and the normal that of one of its edges") {
  const auto shape = polygon_shape(kL);
  CHECK(shape->nearest({0, 0}).distance == 0);
  CHECK(shape->nearest({0, 0}).normal.cwiseAbs().sum() == 1);
  CHECK(shape->nearest({0, 0}).normal.dot(Vector2d(1, 1)) == 1);
  CHECK(shape->nearest({1, -1}).normal.dot(Vector2d(1, -1)) == 1);
}

TEST_CASE("a polygon on the axis of symmetry is one with its mirror image, and the axis is no border of it") {
  const Polygon half = {{0, 0}, {1, 1}, {1, 3}, {0, 3}};
  const Polygon whole = with_mirror_image(half);
  REQUIRE(whole.size() == 6);
  CHECK(std::abs(signed_area(whole)) == Approx(2 * signed_area(half)));
  CHECK(polygon_shape(whole)->nearest({0.01, 2.5}).distance == Approx(-0.5));
  CHECK(with_mirror_image({{0, 3}, {0, 2}, {0, 0}, {1, 1}}).size() == 4);  // straight corners on the axis go
  const Polygon ring = {{1, 0}, {2, 0}, {2, 1}};
  CHECK(with_mirror_image(ring) == ring);
  CHECK_THROWS_WITH(with_mirror_image({{-1, 0}, {2, 0}, {2, 1}}), Contains("beyond the axis"));
  CHECK_THROWS_WITH(with_mirror_image({{0, 0}, {2, 0}, {2, 3}, {0, 3}, {0, 2}, {1, 2}, {1, 1}, {0, 1}}),
                    Contains("several edges on the axis"));
}

TEST_CASE("corners that bound no polygon, and a rounding that does not fit, are refused") {
  CHECK_THROWS_WITH(polygon_shape({{0, 0}, {1, 0}}), Contains("three corners"));
  CHECK_THROWS_WITH(polygon_shape({{0, 0}, {1, std::nan("")}, {1, 1}}), Contains("a corner is not finite"));
  CHECK_THROWS_WITH(polygon_shape({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), Contains("after corners 1 and 3"));
  CHECK_THROWS_WITH(polygon_shape(kL, std::nan("")), Contains("the rounding nan is not 0 or more"));
  CHECK_THROWS_WITH(polygon_shape(kL, -1), Contains("the rounding -1 is not 0 or more"));
  CHECK_NOTHROW(polygon_shape(kL, 0.5));
  CHECK_THROWS_WITH(polygon_shape(kL, 0.51), Contains("the rounding 0.51 is too large for the polygon's corner"));
  // The arcs fit on the edges, but the disc of one contains a reflex corner; or the disc fits, but its arc no edge.
  CHECK_THROWS_WITH(polygon_shape({{0, 0}, {4, 0}, {4, 3}, {0.5, 0.5}, {3, 4}, {0, 4}}, 0.4),
                    Contains("corner (0, 0)"));
  CHECK_THROWS_WITH(polygon_shape({{0, 0}, {4, 0}, {4, 4}, {-1, 4}, {-1, 0.3}, {0, 0.3}}, 0.5),
                    Contains("is too large"));
}

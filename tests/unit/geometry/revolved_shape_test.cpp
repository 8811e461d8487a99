// Rigid bodies of revolution.
#include "geometry/revolved_shape.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "geometry/polygon_shape.hpp"
#include "geometry/quadric_solid.hpp"
#include "geometry/simple_shapes.hpp"
#include "shape_checks.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using Eigen::Vector2d, Eigen::Vector3d;

TEST_CASE("a cylinder of any direction has the signed distance of the solid that bodies have") {
  const auto solid = QuadricSolid::cylinder({-0.4, -0.3, -0.2}, {0.5, 0.4, 0.6}, 0.5, 0);
  check_shape(*cylinder({-0.4, -0.3, -0.2}, {0.5, 0.4, 0.6}, 0.5), 1.2, [&](const Vector3d& x) {
    return solid.contains({x[0], x[1], x[2]});
  });
}

TEST_CASE("a rounded cylinder has edges of the radius r") {
  constexpr double R = 0.6, H = 0.8, r = 0.2;
  const auto shape = cylinder({0, 0, 0}, {0, 0, H}, R, r);
  check_shape(*shape, 1, [](const Vector3d& x) {
    const double across = std::max(std::hypot(x[0], x[1]) - (R - r), 0.0);
    const double along = std::max({r - x[2], x[2] - (H - r), 0.0});
    return std::hypot(across, along) <= r;
  });
  CHECK(shape->nearest({R, 0, H}).distance == Approx(r * (std::sqrt(2) - 1)).epsilon(1e-13));
}

TEST_CASE("a cone, sharp or rounded, has the signed distance of its flank and tip") {
  constexpr double beta = std::numbers::pi / 6, r = 0.2;
  const Vector3d tip(0.1, -0.2, 0.3), a = Vector3d(1, 2, -2) / 3;
  const auto inside = [&](const Vector3d& x) {
    const double s = (x - tip).dot(a);
    return (x - tip - s * a).norm() * std::cos(beta) <= s * std::sin(beta);
  };
  check_shape(*cone(tip, 2 * a, beta), 1.2, inside);
  check_shape(*cone(tip, a, beta, r), 1.2, [&](const Vector3d& x) {
    const double centre = r / std::sin(beta), tangent = centre - r * std::sin(beta);
    return inside(x) && ((x - tip).dot(a) >= tangent || (x - tip - centre * a).norm() <= r);
  });
  CHECK(cone(tip, a, beta, r)->nearest(tip).distance == Approx(r).epsilon(1e-13));
}

TEST_CASE("a cone with a shaft has the signed distance of both together") {
  constexpr double beta = std::numbers::pi / 6, R = 0.4;
  const Vector3d tip(0.1, -0.2, 0.3), a = Vector3d(1, 2, -2) / 3;
  check_shape(*cone(tip, a, beta, 0, R), 1.2, [&](const Vector3d& x) {
    const double s = (x - tip).dot(a), across = (x - tip - s * a).norm();
    return across * std::cos(beta) <= s * std::sin(beta) && across <= R;
  });
  const Vector3d beside = tip + 100 * a + 0.5 * a.unitOrthogonal();
  CHECK(cone(tip, a, beta, 0.1, R)->nearest(beside).distance == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("a disc turned about an axis through its centre is a sphere, on the axis too") {
  const auto turned = revolved(ball<2>({0, 0.5}, 0.7), {0, 0, 0}, {0, 0, 1});
  const auto sphere = ball<3>({0, 0, 0.5}, 0.7);
  auto positions = positions_by_chance<3>(200, 2);
  positions.emplace_back(0, 0, 2);
  positions.emplace_back(0, 0, -1);
  Largest off;
  for (const Vector3d& x : positions) {
    const Nearest<3> here = turned->nearest(x), exact = sphere->nearest(x);
    off.take_magnitude(here.distance - exact.distance);
    off.take((here.normal - exact.normal).norm());
    off.take((here.hessian - exact.hessian).norm() / (1 + exact.hessian.norm()));
  }
  CHECK(off.value() < 1e-13);
}

TEST_CASE("a turned polygon that is not convex has the signed distance of its ring") {
  const Polygon profile = {{0.3, -0.5}, {0.9, -0.5}, {0.9, 0.4}, {0.6, 0.4}, {0.6, -0.1}, {0.3, -0.1}};
  check_shape(*revolved(polygon_shape(profile), {0, 0, 0}, {0, 1, 0}), 1.2, [&](const Vector3d& x) {
    return contains(profile, {std::hypot(x[0], x[2]), x[1]});
  });
}

TEST_CASE("a body of revolution without an axis or a size is refused") {
  CHECK_THROWS_WITH(revolved(ball<2>({0, 0}, 1), {0, 0, 0}, {0, 0, 0}), Contains("an axis has no direction"));
  CHECK_THROWS_WITH(cylinder({0, 0, 0}, {0, 0, 0}, 1), Contains("a box does not begin below its end"));
  CHECK_THROWS_WITH(cylinder({0, 0, 0}, {0, 0, 1}, 0), Contains("a box does not begin below its end"));
  CHECK_THROWS_WITH(cylinder({0, 0, 0}, {0, 0, 1}, 0.4, 0.5), Contains("the rounding 0.5"));
  CHECK_THROWS_WITH(cone({0, 0, 0}, {0, 0, 1}, 2), Contains("half angle"));
  CHECK_THROWS_WITH(cone({std::nan(""), 0, 0}, {0, 0, 1}, 1), Contains("is not finite"));
}

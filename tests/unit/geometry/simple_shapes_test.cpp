// Half-space, ball, box and wedge: what they are at positions by chance, and exact values at faces, edges and corners.
#include "geometry/simple_shapes.hpp"

#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "shape_checks.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <int N>
bool in_box(const Eigen::Vector<double, N>& x, const Eigen::Vector<double, N>& low,
            const Eigen::Vector<double, N>& high) {
  return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
}

/// True within a wedge with its tip at the origin along y.
bool in_wedge(const Vector2d& x, double half_angle) {
  return std::abs(x[0]) * std::cos(half_angle) <= x[1] * std::sin(half_angle);
}

}  // namespace

TEST_CASE("a half-space has the signed distance of its plane, whatever the length of its normal") {
  check_shape(*half_space<2>({0.1, 0.2}, {3, 4}), 2,
              [](const Vector2d& x) { return 3 * (x[0] - 0.1) + 4 * (x[1] - 0.2) <= 0; });
  check_shape(*half_space<3>({0.1, 0.2, 0}, {1, -2, 2}), 2,
              [](const Vector3d& x) { return x[0] - 0.1 - 2 * (x[1] - 0.2) + 2 * x[2] <= 0; });
  CHECK(half_space<2>({0, 1}, {0, 7})->nearest({5, 1.25}).distance == 0.25);
}

TEST_CASE("a disc and a sphere have the signed distance of their circle, also at the centre") {
  const Vector2d centre(0.2, -0.1);
  const Vector3d middle(0.2, -0.1, 0.3);
  check_shape(*ball<2>(centre, 0.8), 1.5, [&](const Vector2d& x) { return (x - centre).norm() <= 0.8; });
  check_shape(*ball<3>(middle, 0.8), 1.5, [&](const Vector3d& x) { return (x - middle).norm() <= 0.8; });
  CHECK(ball<2>(centre, 0.8)->nearest(centre).distance == -0.8);
  CHECK(ball<2>(centre, 0.8)->nearest(centre).normal.norm() == 1);
  CHECK(ball<3>({0, 0, 0}, 2)->nearest({0, 0, 2}).hessian.isApprox(Vector3d(0.5, 0.5, 0).asDiagonal().toDenseMatrix()));
}

TEST_CASE("a box, sharp or rounded, has the signed distance of its faces, edges and corners") {
  const Vector2d low(-0.5, -0.3), high(0.7, 0.6);
  const Vector3d bottom(-0.5, -0.3, -0.6), top(0.7, 0.6, 0.1);
  check_shape(*box<2>(low, high), 1.5, [&](const Vector2d& x) { return in_box<2>(x, low, high); });
  check_shape(*box<3>(bottom, top), 1.5, [&](const Vector3d& x) { return in_box<3>(x, bottom, top); });
  constexpr double r = 0.2;
  check_shape(*box<3>(bottom, top, r), 1.5, [&](const Vector3d& x) {
    const Vector3d nearest = x.cwiseMax(bottom + Vector3d::Constant(r)).cwiseMin(top - Vector3d::Constant(r));
    return (x - nearest).norm() <= r;
  });
}

TEST_CASE("a box is exact on its faces, beyond its edges and at its corners") {
  const auto shape = box<3>({0, 0, 0}, {1, 2, 4});
  CHECK(shape->nearest({0.5, 1, 3.75}).distance == -0.25);
  CHECK(shape->nearest({0.5, 2, 3}).distance == 0);
  CHECK(shape->nearest({0.5, 2, 3}).normal == Vector3d(0, 1, 0));
  CHECK(shape->nearest({4, 6, 3}).distance == 5);
  CHECK(shape->nearest({4, 6, 3}).normal.isApprox(Vector3d(0.6, 0.8, 0)));
  CHECK(shape->nearest({3, 4, 5}).distance == 3);
  CHECK(shape->nearest({1, 2, 4}).distance == 0);
  CHECK(shape->nearest({0.5, -3, 2}).hessian.isZero(0));
}

TEST_CASE("the corner of a rounded box is off its sharp place by r (sqrt N - 1), and its sides stay where they are") {
  const double r = 0.25;
  CHECK(box<2>({0, 0}, {1, 1}, r)->nearest({1, 1}).distance == Approx(r * (std::sqrt(2) - 1)).epsilon(1e-14));
  CHECK(box<3>({0, 0, 0}, {1, 1, 1}, r)->nearest({1, 1, 1}).distance == Approx(r * (std::sqrt(3) - 1)).epsilon(1e-14));
  CHECK(box<2>({0, 0}, {1, 1}, r)->nearest({1, 0.5}).distance == 0);
  CHECK(box<2>({0, 0}, {1, 1}, r)->nearest({0.9, 0.5}).distance == Approx(-0.1).epsilon(1e-14));
  CHECK(box<2>({0, 0}, {1, 1}, 0.5)->nearest({0.5, 0.5}).distance == -0.5);  // a disc
}

TEST_CASE("a wedge, sharp or rounded, has the signed distance of its flanks and tip") {
  constexpr double beta = std::numbers::pi / 6, r = 0.3;
  check_shape(*wedge({0, 0}, {0, 1}, beta), 1.5, [](const Vector2d& x) { return in_wedge(x, beta); });
  const double centre = r / std::sin(beta), tangent = centre - r * std::sin(beta);
  check_shape(*wedge({0, 0}, {0, 2}, beta, r), 1.5, [&](const Vector2d& x) {
    return in_wedge(x, beta) && (x[1] >= tangent || (x - Vector2d(0, centre)).norm() <= r);
  });
}

TEST_CASE(
    "the tip of a rounded wedge is off its sharp place by r (1/sin beta - 1), and its flanks stay where they are") {
  constexpr double beta = std::numbers::pi / 6;
  const auto shape = wedge({1, 2}, {1, 0}, beta, 0.5);
  CHECK(shape->nearest({1, 2}).distance == Approx(0.5).epsilon(1e-13));
  CHECK(shape->nearest({3, 2}).distance == Approx(-2 * std::sin(beta)).epsilon(1e-13));
  const Vector2d on_flank = Vector2d(1, 2) + 3 * Vector2d(std::cos(beta), std::sin(beta));
  CHECK(std::abs(shape->nearest(on_flank).distance) < 1e-15);
  CHECK(shape->nearest(on_flank).normal.isApprox(Vector2d(-std::sin(beta), std::cos(beta)), 1e-14));
}

TEST_CASE("a wedge with a shaft, sharp or rounded, has the signed distance of its flanks, shoulders and sides") {
  constexpr double beta = std::numbers::pi / 6, R = 0.4, r = 0.15;
  const auto inside = [](const Vector2d& x) { return in_wedge(x, beta) && std::abs(x[0]) <= R; };
  check_shape(*wedge({0, 0}, {0, 1}, beta, 0, R), 1.5, inside);
  const double to_tip = r / std::sin(beta), to_shoulder = to_tip + (R - r) / std::tan(beta);
  check_shape(*wedge({0, 0}, {0, 1}, beta, r, R), 1.5, [&](const Vector2d& x) {
    const Vector2d from_tip(x[0], x[1] - to_tip), from_shoulder(std::abs(x[0]) - (R - r), x[1] - to_shoulder);
    const bool at_tip = x[1] < to_tip - r * std::sin(beta);
    const bool at_shoulder =
        from_shoulder.y() < 0 && std::sin(beta) * from_shoulder.x() + std::cos(beta) * from_shoulder.y() > 0;
    return inside(x) && (!at_tip || from_tip.norm() <= r) && (!at_shoulder || from_shoulder.norm() <= r);
  });
}

TEST_CASE("a shaft has no end, and a wedge with a shaft that is wide enough is one without") {
  constexpr double beta = std::numbers::pi / 6;
  const auto shape = wedge({1, 2}, {1, 0}, beta, 0.1, 0.5);
  CHECK(shape->nearest({1e6, 2.75}).distance == Approx(0.25).epsilon(1e-14));
  CHECK(shape->nearest({1e6, 2.75}).normal == Vector2d(0, 1));
  CHECK(shape->nearest({1e6, 1.75}).distance == Approx(-0.25).epsilon(1e-14));
  CHECK(wedge({1, 2}, {1, 0}, beta, 0.5, 0.5)->nearest({1e6, 2}).distance == -0.5);  // a rounded bar
  const auto wide = wedge({1, 2}, {1, 0}, beta, 0.1, 1e6), free = wedge({1, 2}, {1, 0}, beta, 0.1);
  Largest off;
  for (const Vector2d& x : positions_by_chance<2>(100, 5)) {
    off.take_magnitude(wide->nearest(x).distance - free->nearest(x).distance);
    off.take((wide->nearest(x).normal - free->nearest(x).normal).norm());
  }
  CHECK(off.value() == 0);
}

TEST_CASE("what is outside a wedge has the signed distance of the notch") {
  constexpr double beta = std::numbers::pi / 6;
  check_shape(*outside_of(wedge({0, 0}, {0, 1}, beta)), 1.5, [](const Vector2d& x) { return !in_wedge(x, beta); });
}

TEST_CASE("there is no shape of no direction, no size or too large a rounding, and the error says which") {
  CHECK_THROWS_WITH(half_space<2>({0, 0}, {0, 0}), Contains("the normal of a half-space has no direction"));
  CHECK_THROWS_WITH(half_space<3>({0, kNaN, 0}, {0, 0, 1}), Contains("the point of a half-space is not finite"));
  CHECK_THROWS_AS(half_space<3>({0, 0, 0}, {0, 0, kNaN}), std::invalid_argument);
  for (const double radius : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_WITH(ball<2>({0, 0}, radius), Contains("radius"));
  CHECK_THROWS_WITH(ball<2>({kNaN, 0}, 1), Contains("the centre is not finite"));
  CHECK_THROWS_WITH(box<2>({0, 0}, {1, 0}), Contains("a box does not begin below its end"));
  CHECK_THROWS_WITH(box<2>({0, 0}, {1, 3}, 0.6), Contains("the rounding 0.6 is not between 0 and 0.5"));
  CHECK_THROWS_WITH(box<2>({0, 0}, {1, 3}, -0.1), Contains("the rounding -0.1"));
  CHECK_THROWS_WITH(wedge({0, 0}, {0, 0}, 1), Contains("direction"));
  CHECK_THROWS_WITH(wedge({0, kNaN}, {0, 1}, 1), Contains("the tip is not finite"));
  CHECK_THROWS_WITH(wedge({0, 0}, {1e200, 0}, 1), Contains("direction"));
  CHECK_THROWS_WITH(wedge({0, 0}, {0, 1}, 1, 0, 0), Contains("the radius 0 of the shaft is not positive"));
  CHECK_THROWS_WITH(wedge({0, 0}, {0, 1}, 1, 0.3, 0.2), Contains("the rounding 0.3 is not between 0 and 0.2"));
  for (const double angle : {0.0, 1.6, kNaN}) CHECK_THROWS_WITH(wedge({0, 0}, {0, 1}, angle), Contains("half angle"));
}

// Where a turned and moved rigid body is.
#include "geometry/rigid_placement.hpp"

#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "geometry/simple_shapes.hpp"
#include "shape_checks.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using std::numbers::pi;

namespace {

/// Ω by central differences of Q along θ(t) = theta + t dtheta_dt.
template <int N>
Eigen::Matrix<double, N, N> spin_by_differences(const Turning<N>& theta, const Turning<N>& dtheta_dt) {
  constexpr double h = 1e-5;
  const Turning<N> step = h * dtheta_dt;
  return (rotation<N>(theta + step) - rotation<N>(theta - step)) / (2 * h) * rotation<N>(theta).transpose();
}

RigidPlacement<3> placement_in_space() {
  return {.a = {0.1, 0.2, 0.3},
          .u = {-0.3, 0.4, 0.2},
          .Q = rotation<3>({0.4, -0.7, 1.1}),
          .du_dt = {1, 2, 3},
          .Omega = spin<3>({0.4, -0.7, 1.1}, {0.5, 0.2, -0.3})};
}

}  // namespace

TEST_CASE("a quarter turn takes x to y in the plane, and along z in space") {
  CHECK(rotation<2>(Turning<2>(pi / 2)).isApprox((Matrix2d() << 0, -1, 1, 0).finished()));
  CHECK((rotation<3>({0, 0, pi / 2}) * Vector3d(1, 0, 0)).isApprox(Vector3d(0, 1, 0)));
  CHECK((rotation<3>({pi / 2, 0, 0}) * Vector3d(0, 1, 0)).isApprox(Vector3d(0, 0, 1)));
  CHECK(rotation<3>({0, 0, 0}) == Matrix3d::Identity());
}

TEST_CASE("the spin is the rate of the rotation, about a changing axis and at small angles too") {
  CHECK(spin<2>(Turning<2>(0.7), Turning<2>(-1.3))
            .isApprox(spin_by_differences<2>(Turning<2>(0.7), Turning<2>(-1.3)), 1e-9));
  for (const double size : {0.0, 1e-9, 1e-3, 0.0999, 0.1001, 1.0, 3.0, 7.0}) {
    CAPTURE(size);
    const Turning<3> theta = size * Vector3d(2, -3, 6) / 7, dtheta_dt(0.5, 0.2, -0.3);
    CHECK(spin<3>(theta, dtheta_dt).isApprox(spin_by_differences<3>(theta, dtheta_dt), 1e-9));
  }
}

TEST_CASE("the way into the body and back leads to the same position, and the centre only moves by u") {
  const RigidPlacement<3> placement = placement_in_space();
  for (const Vector3d& x : positions_by_chance<3>(20, 1)) {
    CHECK(placement.to_space(placement.to_body(x)).isApprox(x, 1e-14));
    CHECK((placement.to_body(x) - placement.a).norm() == Approx((x - placement.a - placement.u).norm()).epsilon(1e-14));
  }
  CHECK(placement.to_space(placement.a).isApprox(placement.a + placement.u, 1e-15));
}

TEST_CASE("points of the body move with its velocity") {
  constexpr double h = 1e-6;
  const Turning<2> theta(0.4), dtheta_dt(1.5);
  const RigidPlacement<2> now{
      .a = {1, 2}, .u = {0.1, 0.2}, .Q = rotation<2>(theta), .du_dt = {3, -1}, .Omega = spin<2>(theta, dtheta_dt)};
  RigidPlacement<2> later = now;
  later.u += h * now.du_dt;
  later.Q = rotation<2>(theta + h * dtheta_dt);
  for (const Vector2d& X : positions_by_chance<2>(10, 2))
    CHECK(((later.to_space(X) - now.to_space(X)) / h).isApprox(now.velocity(now.to_space(X)), 1e-5));
}

TEST_CASE("a turned box has the signed distance of the turned box, with its normals in space") {
  const RigidPlacement<3> placement = placement_in_space();
  const auto shape = box<3>({0, 0, 0}, {0.6, 0.5, 0.4});
  struct Placed final : RigidShape<3> {
    Placed(const RigidPlacement<3>& p, const RigidShape<3>& s) : placement(p), shape(s) {}
    Nearest<3> nearest(const Vector3d& x) const override { return placement.nearest(shape, x); }
    const RigidPlacement<3>& placement;
    const RigidShape<3>& shape;
  };
  check_shape(Placed(placement, *shape), 1.2, [&](const Vector3d& x) {
    const Vector3d X = placement.Q.inverse() * (x - placement.a - placement.u) + placement.a;
    return X.minCoeff() >= 0 && X[0] <= 0.6 && X[1] <= 0.5 && X[2] <= 0.4;
  });
}

// Rigid bodies that formulas move.
#include "space/boundary/rigid_motion.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace stillpoint;
using Catch::Matchers::Contains;
using Eigen::Vector2d, Eigen::Vector3d;

namespace {

Expression formula(const std::string& text) { return Expression(text, {}); }

constexpr double kTimeScale = 1e-3;

}  // namespace

TEST_CASE("a body moves and turns in the plane as its formulas say, about a position that moves with it") {
  const RigidMotion<2> motion({formula("0.1*t"), formula("sin(t)")}, {formula("0.5*t^2")}, {1, 2}, kTimeScale);
  CHECK(motion.moves());
  const RigidPlacement<2> placement = motion.at(2);
  CHECK(placement.to_space({1, 2}).isApprox(Vector2d(1.2, 2 + std::sin(2))));
  const Vector2d arm(std::cos(2), std::sin(2));
  CHECK(placement.to_space({2, 2}).isApprox(Vector2d(1.2, 2 + std::sin(2)) + arm));
  CHECK(placement.velocity(placement.to_space({2, 2}))
            .isApprox(Vector2d(0.1, std::cos(2)) + 2 * Vector2d(-arm[1], arm[0]), 1e-9));
}

TEST_CASE("a body turns in space by a rotation vector of three formulas") {
  const RigidMotion<3> motion({}, {formula("0"), formula("0"), formula("3*t")}, {0, 0, 5}, kTimeScale);
  const RigidPlacement<3> placement = motion.at(0.1);
  CHECK(placement.to_space({1, 0, 0}).isApprox(Vector3d(std::cos(0.3), std::sin(0.3), 0)));
  CHECK(placement.velocity({0, 2, 0}).isApprox(Vector3d(-6, 0, 0), 1e-9));
}

TEST_CASE("a body without formulas, or with constant ones, does not move") {
  const RigidMotion<2> still({}, {}, {0, 0}, kTimeScale);
  CHECK_FALSE(still.moves());
  CHECK(still.at(3).to_space({4, 5}) == Vector2d(4, 5));
  const RigidMotion<2> shifted({formula("0.5"), formula("0")}, {}, {0, 0}, kTimeScale);
  CHECK_FALSE(shifted.moves());
  CHECK(shifted.at(3).to_space({4, 5}) == Vector2d(4.5, 5));
  CHECK(shifted.at(3).velocity({4, 5}) == Vector2d(0, 0));
}

TEST_CASE("a rigid motion of another number of formulas, or of formulas that vary in space, is refused") {
  CHECK_THROWS_WITH(RigidMotion<2>({formula("t")}, {}, {0, 0}, kTimeScale),
                    Contains("the translation of a rigid body has 2 formulas, not 1"));
  CHECK_THROWS_WITH(RigidMotion<3>({}, {formula("t")}, {0, 0, 0}, kTimeScale),
                    Contains("the rotation of a rigid body has 3 formulas, not 1"));
  CHECK_THROWS_WITH(RigidMotion<2>({}, {formula("x*t")}, {0, 0}, kTimeScale), Contains("varies in space: 'x*t'"));
}

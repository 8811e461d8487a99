#include <stillpoint/mass.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "chain.hpp"

using Catch::Matchers::Contains;
using stillpoint::Mass;
using stillpoint::SparseMatrix;
using stillpoint::test::Chain;

namespace {

// M_ij = Σ_p m_p N_ip N_jp for linear hats on `cells` cells of length 1, with points at x and m_p = 1/points.size().
SparseMatrix hat_mass(int cells, const std::vector<double>& x) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(cells + 1, cells + 1);
  for (double at : x) {
    const int cell = static_cast<int>(at);
    const double s = at - cell, N[2] = {1 - s, s};
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) M(cell + i, cell + j) += N[i] * N[j] / static_cast<double>(x.size());
    }
  }
  return M.sparseView();
}

}  // namespace

TEST_CASE("a lumped mass multiplies and divides by its diagonal") {
  const Mass mass = Mass::lumped({1, 2, 4});
  CHECK(mass.is_lumped());
  CHECK(mass.size() == 3);
  std::vector<double> x = {8, 8, 8}, y(3);
  mass.apply(x, y);
  CHECK(y == std::vector<double>{8, 16, 32});
  mass.solve(x, x);
  CHECK(x == std::vector<double>{8, 4, 2});
  const Eigen::MatrixXd expected = Eigen::Vector3d(1, 2, 4).asDiagonal();
  CHECK(Eigen::MatrixXd(mass.matrix()) == expected);
}

TEST_CASE("a lumped mass that is not positive is refused by the number of its degree of freedom") {
  const double bad =
      GENERATE(0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH(Mass::lumped({1, 1, bad}), Contains("degree of freedom 2 of 3"));
  CHECK_THROWS_AS(Mass::lumped({bad}), std::invalid_argument);
}

TEST_CASE("relative inertia resists what deviates from the extrapolation, and no linear motion") {
  // Of the node at x = 0 relative to those at 1 and 2, whose extrapolation is 2 v_1 − v_2; of the last against all.
  const std::vector<double> m = {0.01, 1, 2, 0.5};
  const std::vector<stillpoint::RelativeInertia> relative = {
      {.dof = 0, .inertia = 3, .masters = 2, .master = {1, 2}, .weight = {2, -1}}, {.dof = 3, .inertia = 0.25}};
  const Mass mass = Mass::lumped(m, relative);
  const Eigen::Vector4d q(1, -2, 1, 0), last(0, 0, 0, 1);
  const Eigen::Matrix4d expected = Eigen::Matrix4d(Eigen::Vector4d(0.01, 1, 2, 0.5).asDiagonal()) +
                                   3 * q * q.transpose() + 0.25 * last * last.transpose();
  CHECK(mass.is_lumped());
  CHECK_FALSE(mass.is_diagonal());
  CHECK((Eigen::MatrixXd(mass.matrix()) - expected).norm() < 1e-14);
  CHECK((Eigen::Map<const Eigen::VectorXd>(mass.diagonal().data(), 4) - expected.diagonal()).norm() < 1e-14);
  std::vector<double> x = {1, -2, 3, 5}, y(4), linear = {4, 5, 6, 0};
  const Eigen::Vector4d v = Eigen::Map<const Eigen::Vector4d>(x.data());
  mass.apply(x, y);
  CHECK((Eigen::Map<const Eigen::Vector4d>(y.data()) - expected * v).norm() < 1e-13);
  CHECK(mass.relative_energy(x) == Approx(0.5 * 3 * std::pow(q.dot(v), 2) + 0.5 * 0.25 * 25));
  mass.solve(y, y);
  CHECK((Eigen::Map<const Eigen::Vector4d>(y.data()) - v).norm() < 1e-12);
  CHECK(mass.relative_energy(linear) == 0);
  mass.apply(x, y);
  mass.decouple(y);
  for (std::size_t i = 0; i < 4; ++i) CHECK(y[i] / mass.diagonal()[i] == Approx(x[i]).epsilon(1e-12));
  mass.apply(linear, y);
  for (std::size_t i = 0; i < 3; ++i) CHECK(y[i] == Approx(m[i] * linear[i]).margin(1e-13));  // of 3 · 5
  // A node that has no mass of its own.
  CHECK_NOTHROW(Mass::lumped({0, 1, 1, 1}, relative));
  CHECK_THROWS_AS(Mass::lumped({0, 0, 1, 0}, {relative.front()}), std::invalid_argument);
}

TEST_CASE("relative inertia so large that the rest of the mass is lost in rounding is refused, not factorised") {
  const std::vector<stillpoint::RelativeInertia> relative = {
      {.dof = 0, .inertia = 1e20, .masters = 1, .master = {1}, .weight = {1}}};  // [[1e20, -1e20], [-1e20, 1e20]]
  CHECK_THROWS_WITH(Mass::lumped({1e-3, 1}, relative), Contains("not positive definite to rounding"));
}

TEST_CASE("a consistent mass solves what it multiplies, in place as well") {
  const Chain chain({.masses = {1, 3, 2, 0.01, 5}, .consistent = true});
  const Mass& mass = chain.mass();
  CHECK_FALSE(mass.is_lumped());
  CHECK(mass.diagonal()[1] == Approx(2));
  const std::vector<double> x = {1, -2, 3, -4, 5};
  std::vector<double> y(5), z(5);
  mass.apply(x, y);
  const Eigen::VectorXd expected = mass.matrix() * Eigen::Map<const Eigen::VectorXd>(x.data(), 5);
  for (std::size_t i = 0; i < 5; ++i) CHECK(y[i] == Approx(expected[static_cast<Eigen::Index>(i)]).epsilon(1e-14));
  mass.solve(y, z);
  mass.solve(y, y);
  for (std::size_t i = 0; i < 5; ++i) CHECK(z[i] == Approx(x[i]).epsilon(1e-12));
  CHECK(y == z);
}

TEST_CASE("a consistent mass outlives moves") {
  Mass first = Mass::consistent(hat_mass(2, {0.2, 0.8, 1.2, 1.8}));
  const Mass second = std::move(first);
  std::vector<double> x = {1, 2, 3}, y(3);
  second.apply(x, y);
  second.solve(y, y);
  for (std::size_t i = 0; i < 3; ++i) CHECK(y[i] == Approx(x[i]));
}

TEST_CASE("too few material points for the basis make a consistent mass that is refused with the way out") {
  // One point in each of two cells cannot hold three hats; the exact zero pivot may survive rounding as a tiny number.
  for (const double at : {0.5, 0.3, 0.1}) {
    CHECK_THROWS_WITH(Mass::consistent(hat_mass(2, {at, 1 + at / 3})),
                      Contains("more points per cell") && Contains("mass.kind = \"lumped\""));
  }
  CHECK_THROWS_AS(Mass::consistent(hat_mass(3, {0.1, 0.7, 2.1})), std::invalid_argument);  // 3 points, 4 hats
  CHECK_NOTHROW(Mass::consistent(hat_mass(2, {0.3, 0.7, 1.3, 1.7})));
}

#include <stillpoint/principal_stresses.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "space/materials/eigen_tensors.hpp"

namespace stillpoint {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using test::matrix_of, test::tensor_of_matrix;

Matrix3d random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

Matrix3d with_values(const Vector3d& values, const Matrix3d& axes) {
  const Matrix3d s = axes * values.asDiagonal() * axes.transpose();
  return (s + s.transpose()) / 2;
}

// Deviators of every kind: any, equal largest or least values, values that differ by down to the last digits.
std::vector<Vector3d> deviators() {
  std::vector<Vector3d> all = {{1, 0, -1}, {1, 1, -2}, {2, -1, -1}, {0, 0, 0}, {1e-90, 0, -1e-90}};
  for (int k = 1; k <= 16; ++k) {
    const double close = std::pow(10, -k);
    all.push_back({1 + close, 1 - close, -2});
    all.push_back({2, -1 + close, -1 - close});
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Vector3d any{value(random), value(random), value(random)};
    all.push_back(any.array() - any.mean());
  }
  return all;
}

Vector3d sorted(Vector3d values) {
  std::ranges::sort(values, std::greater<>());
  return values;
}

}  // namespace

TEST_CASE("the principal values of a deviator in space are right to rounding, equal and nearly equal ones too") {
  std::mt19937 random(2);
  for (const Vector3d& values : deviators()) {
    const Matrix3d axes = random_rotation(random);
    const Principal<double> found = SpacePrincipal<double>(tensor_of_matrix(with_values(values, axes))).values();
    const Vector3d exact = sorted(values);
    const double largest = 4e-15 * std::max(values.lpNorm<Eigen::Infinity>(), 1e-75);  // of a rotated tensor
    CAPTURE(exact.transpose(), found[0], found[1], found[2]);
    for (int a = 0; a < 3; ++a) CHECK(std::abs(found[a] - exact[a]) <= largest);
  }
}

TEST_CASE("a deviator in space gets other principal values along the same axes") {
  std::mt19937 random(3);
  for (const Vector3d& values : deviators()) {
    const Matrix3d axes = random_rotation(random);
    const Vector3d exact = sorted(values);
    const SpacePrincipal<double> principal(tensor_of_matrix(with_values(exact, axes)));
    // A function of the value, which is smooth: equal values stay equal
    const auto other = [](double x) { return 0.3 * x - 0.05 * x * x; };
    const Vector3d others{other(exact[0]), other(exact[1]), other(exact[2])};
    const double mean = others.mean();
    const Principal<double> of_found = {other(principal.values()[0]), other(principal.values()[1]),
                                        other(principal.values()[2])};
    const Matrix3d found = matrix_of(principal.with(of_found, mean));
    const Matrix3d right = with_values(others.array() - mean, axes);
    CAPTURE(exact.transpose());
    CHECK((found - right).lpNorm<Eigen::Infinity>() <= 4e-15);
  }
}

TEST_CASE("the principal values of a deviator in the plane are those in space") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int k = 0; k < 100; ++k) {
    const PlaneDeviator<double> s{value(random), value(random), k % 10 == 0 ? 0 : value(random)};
    const SpaceTensor in_space{s.half - s.zz / 2, s.shear, 0, s.shear, -s.half - s.zz / 2, 0, 0, 0, s.zz};
    const Principal<double> here = PlanePrincipal<double>(s).values(),
                            there = SpacePrincipal<double>(in_space).values();
    for (int a = 0; a < 3; ++a) CHECK(std::abs(here[a] - there[a]) <= 4e-15);

    const Principal<double> other{0.5, 0.1, -0.6};
    const PlaneDeviator<double> changed = PlanePrincipal<double>(s).with(other, 0.0);
    const SpaceTensor right = SpacePrincipal<double>(in_space).with(other, 0.0);
    CHECK(std::abs(changed.half - (right.xx - right.yy) / 2) <= 1e-12);  // axes of values that are 1e-3 apart
    CHECK(std::abs(changed.shear - right.xy) <= 1e-12);
    CHECK(std::abs(changed.zz - right.zz) <= 1e-12);
  }
}

}  // namespace stillpoint

#include "linalg/positive_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace stillpoint;
using Matrix = Eigen::Matrix4d;

namespace {

/// With eigenvalues lambda on axes that are none of the coordinates'.
Matrix with_eigenvalues(const Eigen::Vector4d& lambda) {
  Matrix directions;
  directions << 1, 2, 3, 4, 0, 1, -1, 2, 5, 1, 0, 1, 2, 2, 1, -3;
  const Matrix Q = Eigen::HouseholderQR<Matrix>(directions).householderQ();
  return Q * lambda.asDiagonal() * Q.transpose();
}

std::array<double, 16> positive_part(const Matrix& A) {
  std::array<double, 16> values;
  Eigen::Map<Matrix>(values.data()) = A;
  take_positive_part(values);
  return values;
}

}  // namespace

TEST_CASE("the positive part keeps positive eigenvalues with their vectors and makes the others zero") {
  const auto values = positive_part(with_eigenvalues({3, -2, 0.5, -1e-3}));
  const Matrix expected = with_eigenvalues({3, 0, 0.5, 0});
  CHECK((Eigen::Map<const Matrix>(values.data()) - expected).norm() <= 1e-14 * expected.norm());
}

TEST_CASE("the positive part of a semi-definite matrix is the matrix, and of an unsymmetric one that of its half sum") {
  const Matrix A = with_eigenvalues({3, 2, 0, 1});
  const auto same = positive_part(A);
  CHECK((Eigen::Map<const Matrix>(same.data()) - A).norm() <= 1e-14 * A.norm());
  Matrix skew = Matrix::Zero();
  skew(0, 2) = 0.7;
  skew(2, 0) = -0.7;
  const auto half = positive_part(A + skew);
  CHECK((Eigen::Map<const Matrix>(half.data()) - A).norm() <= 1e-14 * A.norm());
}

#include "linalg/sparse_lu.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "convection.hpp"
#include "factor_allocations.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "sparse_solutions.hpp"

using stillpoint::SparseCholesky;
using stillpoint::SparseLu;
using stillpoint::SparseMatrix;
using stillpoint::test::convection;
using stillpoint::test::FactorAllocations;
using stillpoint::test::ramp;
using stillpoint::test::residual;

namespace {

SparseMatrix dense(const Eigen::MatrixXd& A) { return A.sparseView(); }

}  // namespace

TEST_CASE("the LU factor solves an unsymmetric system to rounding, in place as well") {
  const int m = GENERATE(1, 2, 10, 100);
  const SparseMatrix A = convection(m, 3);
  const SparseLu factor(A);
  REQUIRE(factor.regular());
  REQUIRE(factor.size() == static_cast<std::size_t>(m * m));
  const std::vector<double> b = ramp(factor.size());
  std::vector<double> x(factor.size());
  factor.solve(b, x);
  CHECK(residual(A, x, b) < 1e-13);
  std::vector<double> same = b;
  factor.solve(same, same);
  CHECK(same == x);
}

TEST_CASE("the LU factor solves an indefinite system, which has no Cholesky factor") {
  const SparseMatrix A = dense(Eigen::Matrix3d{{0, 1, 0}, {1, 0, 2}, {0, 2, -3}});
  REQUIRE_FALSE(SparseCholesky(A).positive_definite());
  const std::vector<double> b = {1, 2, 3};
  std::vector<double> x(3);
  SparseLu(A).solve(b, x);
  CHECK(residual(A, x, b) < 1e-15);
}

TEST_CASE("a singular matrix or one that is not finite is not regular, and solving with it is an error") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SparseMatrix> bad = {dense(Eigen::Matrix2d{{1, 2}, {2, 4}}), dense(Eigen::Matrix2d{{1, 0}, {0, 0}}),
                                   SparseMatrix(2, 2)};
  for (const double value : {nan, inf, -inf}) {
    bad.push_back(convection(20, 1));
    bad.back().coeffRef(7, 7) = value;
  }
  for (const SparseMatrix& A : bad) {
    const SparseLu factor(A);
    CHECK_FALSE(factor.regular());
    std::vector<double> x(factor.size(), 1.0);
    CHECK_THROWS_AS(factor.solve(x, x), std::logic_error);
  }
}

TEST_CASE("a matrix that is not compressed is factorised by LU all the same") {
  SparseMatrix A = dense(Eigen::Matrix2d{{4, 0}, {0, 9}});
  A.reserve(Eigen::VectorXi::Constant(2, 3));
  A.insert(1, 0) = 1;
  REQUIRE_FALSE(A.isCompressed());
  const std::vector<double> b = {5, 10};
  std::vector<double> x(2);
  SparseLu(A).solve(b, x);
  CHECK(residual(A, x, b) < 1e-15);
}

TEST_CASE("a moved LU factor still solves") {
  const std::vector<double> b = {2, 2};
  std::vector<double> x(2);
  SparseLu first(dense(Eigen::Matrix2d{{1, 0}, {0, 2}}));
  SparseLu second = std::move(first);
  second.solve(b, x);
  CHECK(x == std::vector<double>{2, 1});
  SparseLu third(dense(Eigen::Matrix2d{{7, 0}, {0, 7}}));
  third = std::move(second);
  third.solve(b, x);
  CHECK(x == std::vector<double>{2, 1});
}

TEST_CASE("solving with an LU factor allocates nothing, and the factor says what it takes") {
  const FactorAllocations counted;
  const SparseLu small(convection(10, 3)), large(convection(100, 3));
  CHECK(counted.count() > 0);  // it does see the library
  const std::vector<double> b = ramp(large.size());
  std::vector<double> x(large.size());
  const long before = counted.count();
  for (int k = 0; k < 5; ++k) large.solve(b, x);
  CHECK(counted.count() == before);
  const std::size_t real = sizeof(double);
  CHECK(small.bytes() > 5 * 100 * real);         // A alone
  CHECK(large.bytes() > 2 * 20 * 10000 * real);  // log n of fill in each row of L and of U
  CHECK(large.bytes() < 2 * 200 * 10000 * real);
  CHECK(SparseCholesky(convection(100, 0)).bytes() > 10 * 10000 * real);
}

#include "linalg/sparse_cholesky.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "factor_allocations.hpp"
#include "sparse_solutions.hpp"

using stillpoint::SparseCholesky;
using stillpoint::SparseMatrix;
using stillpoint::test::FactorAllocations;
using stillpoint::test::ramp;
using stillpoint::test::residual;

namespace {

// The five-point Laplacian on m × m nodes plus shift · I.
SparseMatrix laplacian(int m, double shift = 0) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < m; ++i) {
      const int k = j * m + i;
      entries.emplace_back(k, k, 4 + shift);
      if (i > 0) entries.emplace_back(k, k - 1, -1), entries.emplace_back(k - 1, k, -1);
      if (j > 0) entries.emplace_back(k, k - m, -1), entries.emplace_back(k - m, k, -1);
    }
  }
  SparseMatrix A(m * m, m * m);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

SparseMatrix diagonal(const std::vector<double>& values) {
  const auto n = static_cast<Eigen::Index>(values.size());
  SparseMatrix A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) A.insert(i, i) = values[static_cast<std::size_t>(i)];
  return A;
}

}  // namespace

TEST_CASE("the Cholesky factor solves to rounding, in place as well, simplicial and supernodal") {
  const int m = GENERATE(1, 2, 10, 150);  // 150 × 150 has enough work per entry for supernodes
  const SparseMatrix A = laplacian(m);
  const SparseCholesky factor(A);
  REQUIRE(factor.positive_definite());
  REQUIRE(factor.size() == static_cast<std::size_t>(m * m));
  const std::vector<double> b = ramp(factor.size());
  std::vector<double> x(factor.size());
  factor.solve(b, x);
  CHECK(residual(A, x, b) < 1e-12);
  std::vector<double> same = b;
  factor.solve(same, same);
  CHECK(same == x);
}

TEST_CASE("a Cholesky factor exists just above the lowest eigenvalue and not below it") {
  const int m = 12;
  const double lowest = 8 * std::pow(std::sin(std::numbers::pi / (2 * (m + 1))), 2);
  CHECK(SparseCholesky(laplacian(m, -lowest * (1 - 1e-8))).positive_definite());
  CHECK_FALSE(SparseCholesky(laplacian(m, -lowest * (1 + 1e-8))).positive_definite());
  CHECK_FALSE(SparseCholesky(laplacian(150, -0.1)).positive_definite());
}

TEST_CASE(
    "a matrix with a zero, negative or non-finite pivot is not positive definite, and solving with it is an error") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const double bad = GENERATE_COPY(0.0, -1.0, nan, inf, -inf);
  const SparseCholesky factor(diagonal({1, bad, 2}));
  CHECK_FALSE(factor.positive_definite());
  std::vector<double> x(3, 1.0);
  CHECK_THROWS_AS(factor.solve(x, x), std::logic_error);
  for (const int m : {3, 150}) {  // simplicial and supernodal
    SparseMatrix coupled = laplacian(m);
    coupled.coeffRef(m, 0) = coupled.coeffRef(0, m) = nan;
    CHECK_FALSE(SparseCholesky(coupled).positive_definite());
  }
  const SparseCholesky empty(SparseMatrix(2, 2));
  CHECK_FALSE(empty.positive_definite());
  CHECK_THROWS_AS(empty.pivot_ratio(), std::logic_error);
}

TEST_CASE("a matrix that is not compressed is factorised all the same") {
  SparseMatrix A = diagonal({4, 9});
  A.reserve(Eigen::VectorXi::Constant(2, 3));
  A.insert(1, 0) = A.insert(0, 1) = 1;
  REQUIRE_FALSE(A.isCompressed());
  const int gap = A.outerIndexPtr()[0] + A.innerNonZeroPtr()[0];  // a place of column 0 that holds nothing
  REQUIRE(gap < A.outerIndexPtr()[1]);
  A.innerIndexPtr()[gap] = 1;
  A.valuePtr()[gap] = 100;
  const std::vector<double> b = {5, 10};
  std::vector<double> x(2);
  SparseCholesky(A).solve(b, x);
  CHECK(residual(A, x, b) < 1e-14);
}

TEST_CASE("a moved Cholesky factor still solves") {
  const std::vector<double> b = {2, 2};
  std::vector<double> x(2);
  SparseCholesky first(diagonal({1, 2}));
  SparseCholesky second = std::move(first);
  second.solve(b, x);
  CHECK(x[0] == Approx(2));
  CHECK(x[1] == Approx(1));
  SparseCholesky third(diagonal({7}));
  third = std::move(second);
  third.solve(b, x);
  CHECK(x[0] == Approx(2));
  CHECK(x[1] == Approx(1));
}

TEST_CASE("solving with a Cholesky factor allocates nothing") {
  const int m = GENERATE(10, 150);
  const FactorAllocations counted;
  const SparseCholesky factor(laplacian(m));
  CHECK(counted.count() > 0);  // it does see the library
  const std::vector<double> b = ramp(factor.size());
  std::vector<double> x(factor.size());
  const long before = counted.count();
  for (int k = 0; k < 5; ++k) factor.solve(b, x);
  CHECK(counted.count() == before);
}

#include "solvers/spectrum/lowest_mode.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "dense.hpp"

using namespace stillpoint;

namespace {

constexpr int n = 40;

// The second difference less shift · I; its lowest eigenvalue is 4 sin²(π/(2n + 2)) − shift.
SparseMatrix chain(double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2 - shift);
    if (i > 0) {
      entries.emplace_back(i, i - 1, -1);
      entries.emplace_back(i - 1, i, -1);
    }
  }
  SparseMatrix K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

Mass uneven_mass() {
  std::vector<double> diagonal;
  for (int i = 0; i < n; ++i) diagonal.push_back(1 + 0.5 * std::sin(3.0 * i));
  return Mass::lumped(diagonal);
}

}  // namespace

TEST_CASE("the lowest mode of an indefinite tangent is that of a dense solution, weakly unstable or far beyond") {
  const Mass mass = uneven_mass();
  for (const double shift : {0.0059, 0.01, 0.5, 2.0, 3.9}) {
    const SparseMatrix K = chain(shift);
    const LowestMode lowest = lowest_mode(K, mass);
    CAPTURE(shift);
    REQUIRE(lowest.found);
    CHECK_FALSE(lowest.positive_definite);
    const double exact = test::dense_eigenvalues(K, mass.matrix())[0];
    CHECK(lowest.omega_squared == Approx(exact).epsilon(1e-6).margin(1e-11));
    REQUIRE(lowest.x.size() == n);
    const Eigen::Map<const Eigen::VectorXd> x(lowest.x.data(), n);
    CHECK((K * x - exact * (mass.matrix() * x)).norm() < 1e-6);
    CHECK(x.dot(mass.matrix() * x) == Approx(1));
  }
}

TEST_CASE("a tangent that is positive definite by more than rounding is said to be, and costs no search") {
  for (const double shift : {-1.0, 0.0, 0.0058}) {
    const LowestMode lowest = lowest_mode(chain(shift), Mass::lumped(std::vector<double>(n, 1.0)));
    CHECK(lowest.positive_definite);
    CHECK(lowest.x.empty());
  }
}

TEST_CASE("a singular tangent is not positive definite, and its lowest eigenvalue is a zero within rounding") {
  SparseMatrix K = chain(0);
  K.coeffRef(0, 0) = K.coeffRef(n - 1, n - 1) = 1;  // held nowhere
  const LowestMode lowest = lowest_mode(K, uneven_mass());
  CHECK_FALSE(lowest.positive_definite);
  REQUIRE(lowest.found);
  CHECK(std::abs(lowest.omega_squared) < lowest.rounding);
}

TEST_CASE("a tangent that is not finite has no lowest mode") {
  SparseMatrix K = chain(0);
  K.coeffRef(3, 3) = std::numeric_limits<double>::quiet_NaN();
  const LowestMode lowest = lowest_mode(K, uneven_mass());
  CHECK_FALSE(lowest.positive_definite);
  CHECK_FALSE(lowest.found);
}

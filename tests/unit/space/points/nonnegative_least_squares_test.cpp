#include "space/points/nonnegative_least_squares.hpp"

#include <random>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

Eigen::MatrixXd random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd E(rows, columns);
  for (double& e : E.reshaped()) e = normal(random);
  return E;
}

// x ≥ 0, the gradient Eᵀ (f − E x) ≤ 0, and 0 where x > 0.
void check_optimal(const Eigen::MatrixXd& E, const Eigen::VectorXd& f) {
  const Eigen::VectorXd x = solve_nnls(E, f);
  const Eigen::VectorXd gradient = E.transpose() * (f - E * x);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    CHECK(x(j) >= 0);
    CHECK(gradient(j) <= 1e-10);
    if (x(j) > 0) CHECK(gradient(j) == Approx(0).margin(1e-10));
  }
}

}  // namespace

TEST_CASE("non-negative least squares satisfies its optimality conditions") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd E = random_matrix(random, 6, 9);
    check_optimal(E, random_matrix(random, 6, 1));
    check_optimal(E.transpose(), random_matrix(random, 9, 1));
  }
}

TEST_CASE(
    "non-negative least squares takes no more columns than are independent, and each of those that are the same once") {
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd half = random_matrix(random, 8, 4);
    Eigen::MatrixXd E(8, 12);
    E << half, half, half * random_matrix(random, 4, 4).cwiseAbs();
    const Eigen::VectorXd f = half * random_matrix(random, 4, 1).cwiseAbs();
    check_optimal(E, f);
    const Eigen::VectorXd x = solve_nnls(E, f);
    CHECK((E * x - f).norm() < 1e-10 * f.norm());
    CHECK((x.array() > 0).count() <= 4);
  }
}

TEST_CASE("a rule of many positions becomes one of as few as there are moments, to rounding") {
  // The powers up to x^9 over [0, 1] at 400 positions with weights 1/400 each.
  Eigen::MatrixXd E(10, 400);
  for (Eigen::Index p = 0; p < E.cols(); ++p) {
    const double x = (static_cast<double>(p) + 0.5) / 400;
    E(0, p) = 1;
    for (Eigen::Index k = 1; k < E.rows(); ++k) E(k, p) = E(k - 1, p) * (2 * x - 1);
  }
  const Eigen::VectorXd f = E.rowwise().mean();
  const Eigen::VectorXd x = solve_nnls(E, f);
  CHECK((E * x - f).lpNorm<Eigen::Infinity>() < 1e-12);
  CHECK(x.minCoeff() >= 0);
  CHECK((x.array() > 0).count() <= 10);
}

#include <cmath>
#include <vector>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "base/stop_request.hpp"
#include "convection.hpp"
#include "largest.hpp"
#include "linalg/krylov.hpp"
#include "linalg/sparse_lu.hpp"

using namespace stillpoint;
using stillpoint::test::convection;

namespace {

struct Problem {
  SparseMatrix A;
  std::vector<double> diagonal, b;

  explicit Problem(SparseMatrix matrix) : A(std::move(matrix)), diagonal(size()), b(size()) {
    for (std::size_t i = 0; i < size(); ++i) {
      diagonal[i] = A.coeff(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
      b[i] = 1 + static_cast<double>(i % 7);
    }
  }
  std::size_t size() const { return static_cast<std::size_t>(A.rows()); }
  LinearMap product() const {
    return [this](ConstVec x, Vec y) {
      Eigen::Map<Eigen::VectorXd>(y.data(), A.rows()) = A * Eigen::Map<const Eigen::VectorXd>(x.data(), A.rows());
    };
  }
};

}  // namespace

TEST_CASE("GMRES solves an unsymmetric system as UMFPACK does, also where it begins again") {
  const double wind = GENERATE(0.0, 0.3, 5.0);
  const Problem problem(convection(60, wind, wind));
  std::vector<double> x(problem.size()), exact(problem.size());
  const IterativeResult result = gmres(problem.product(), division_by(problem.diagonal), problem.b, x, 1e-10, 5000);
  CAPTURE(wind, result.iterations);
  CHECK(result.converged);
  CHECK(result.iterations > 60);
  SparseLu(problem.A).solve(problem.b, exact);
  // What is left out of balance, times a condition number of some thousands.
  CHECK(largest_difference(x, exact) < 1e-6 * largest_magnitude(exact));
}

TEST_CASE("a good preconditioner lets GMRES end in a single iteration") {
  const Problem problem(convection(20, 1.0, 1.0));
  const SparseLu factor(problem.A);
  std::vector<double> x(problem.size());
  const IterativeResult result = gmres(
      problem.product(), [&](ConstVec r, Vec Br) { factor.solve(r, Br); }, problem.b, x, 1e-10, 100);
  CHECK(result.converged);
  CHECK(result.iterations <= 2);  // SUNDIALS forms the residual of the start by one more
}

TEST_CASE("GMRES that has not come to its tolerance says so, and hands on what it is called with") {
  const Problem problem(convection(60, 0.3, 0.3));
  std::vector<double> x(problem.size());
  CHECK_FALSE(gmres(problem.product(), division_by(problem.diagonal), problem.b, x, 1e-10, 60).converged);
  const std::vector<double> nothing(problem.size(), std::nan(""));
  CHECK_FALSE(gmres(problem.product(), division_by(problem.diagonal), nothing, x, 1e-10, 60).converged);
  const LinearMap stopped = [](ConstVec, Vec) { throw Stopped(); };
  CHECK_THROWS_AS(gmres(stopped, division_by(problem.diagonal), problem.b, x, 1e-10, 60), Stopped);
}

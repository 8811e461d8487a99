// Conjugate gradients and GMRES, alone and inside Newton's method.
#include <stillpoint/spectrum.hpp>
#include <stillpoint/static_solution.hpp>

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "solvers/statics/columns_and_cuts.hpp"
#include "statics.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE("conjugate gradients alone solve the linear column within 1/2 sqrt(kappa) ln(2/eps) products") {
  const auto phase = make_phase(column());
  std::vector<double> u(phase->size(), 0.0);
  const StaticReport report = conjugate_gradients(*phase, 0, u, {.tolerance = 1e-8});
  INFO(shown(report));
  CHECK(report.converged);
  CHECK(report.residual <= 1e-8);
  CHECK(report.tangent_products == report.iterations);
  CHECK(distance(u, statics::solution(*phase)) < 1e-7);
  // ‖e‖_K falls by ε in so many; ‖Q‖_M⁻¹ by √κ less
  const std::vector<double> at_rest(u.size(), 0.0);
  const double root_kappa = omega_max_by_arpack(*phase, 0, at_rest).omega / omega_1_by_arpack(*phase, 0, at_rest).omega;
  CHECK(report.iterations < 0.5 * root_kappa * std::log(2 * root_kappa / 1e-8));
}

TEST_CASE("conjugate gradients alone report a system that is not linear, and one that is not definite") {
  const auto phase = make_phase(soft_column("neo-hookean"));
  std::vector<double> u(phase->size(), 0.0);
  const StaticReport nonlinear = conjugate_gradients(*phase, 0, u, {.max_iterations = 100});
  CHECK_FALSE(nonlinear.converged);
  CHECK_THAT(nonlinear.reason, Contains("residual"));
  test::Chain chain({.n = 3, .cubic = -1, .load = 1});
  std::vector<double> e = {1, 2, 3};
  const StaticReport indefinite = conjugate_gradients(chain, 0, e);
  CHECK_FALSE(indefinite.converged);
  CHECK_THAT(indefinite.reason, Contains("positive definite"));
}

TEST_CASE("Newton's method with conjugate gradients inside finds the same answer without a factor, with order 2") {
  for (const auto& law : large_strain) {
    const Solved direct = solve(soft_column(law)), s = solve(soft_column(law), {.solver = LinearSolver::iterative});
    CAPTURE(law);
    INFO(shown(s.report));
    CHECK(s.report.converged);
    CHECK(s.report.factor_bytes == 0);
    CHECK(s.report.tangent_products > 20);
    CHECK(distance(s.u, direct.u) < 1e-8);
    CHECK(observed_order(s.report.load_steps.back().residuals) > 1.8);
  }
}

TEST_CASE(
    "where flow is not associated Newton's method goes by GMRES to the answer of UMFPACK, by laws and by a matrix") {
  const Solved direct = solve(cut(stands + non_associated));
  CHECK(direct.report.lu_factorisations > 0);
  const bool assembles = GENERATE(false, true);
  const Solved s = solve(cut(stands + non_associated), {.solver = LinearSolver::iterative, .assembles = assembles});
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.factor_bytes == 0);
  CHECK(s.report.elastic_iterations == 0);  // the consistent tangent was of use
  CHECK(distance(s.u, direct.u) < 1e-6);
}

TEST_CASE("where the consistent tangent is of no use, conjugate gradients take the elastic one, and no factor") {
  const Solved direct = solve(cut(stands + associated));
  const Solved s = solve(cut(stands + associated), {.max_iterations = 200, .solver = LinearSolver::iterative});
  INFO(shown(s.report));
  CHECK(s.report.converged);
  CHECK(s.report.factor_bytes == 0);
  CHECK(distance(s.u, direct.u) < 1e-4);
}

// Gershgorin's bound on omega_max.
#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "dense.hpp"
#include "solvers/spectrum/frequencies.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE("Gershgorin bounds omega_max from above, close by for an equal chain") {
  for (const ChainOptions& options : held_chains()) {
    const Chain chain(options);
    const Eigen::VectorXd omega = dense_frequencies(chain, at_rest(chain));
    const FrequencyEstimate bound = omega_max_bound_by_gershgorin(chain, 0, at_rest(chain));
    INFO("n = " << chain.size() << (options.consistent ? ", consistent: " : ", lumped: ") << bound.status);
    REQUIRE(bound.converged);
    CHECK(bound.omega >= omega[omega.size() - 1] * (1 - 1e-14));
    CHECK(bound.omega <= 1.8 * omega[omega.size() - 1]);
  }
  const Chain chain({.n = 30});
  CHECK(omega_max_bound_by_gershgorin(chain, 0, at_rest(chain)).omega == Approx(2));  // √4, exactly 2 sin(…) below
}

TEST_CASE("Gershgorin's bound holds where the circles of M reach below zero and a factor has to certify it") {
  Eigen::Matrix3d M, K;
  M << 2, 1.4, 0.9, 1.4, 2, 1.4, 0.9, 1.4, 2;
  K << 2, -1, 0, -1, 3, -1, 0, -1, 4;
  const PlainSystem system(K, M);
  const std::vector<double> u(3, 0.0);
  const double highest = std::sqrt(dense_eigenvalues(K, M).maxCoeff());
  const FrequencyEstimate bound = omega_max_bound_by_gershgorin(system, 0, u);
  REQUIRE(bound.converged);
  CHECK_THAT(bound.status, Contains("a factor of M"));
  CHECK(bound.omega >= highest);
  CHECK(bound.omega <= 1.5 * highest);
  CHECK(omega_max_by_arpack(system, 0, u).omega == near(highest));
}

TEST_CASE("Gershgorin's bound does not change with the units of a degree of freedom") {
  const auto bound_with = [](double s) {  // the second degree of freedom measured in units of 1/s
    Eigen::Matrix2d M, K;
    M << 2, 0.5 * s, 0.5 * s, s * s;
    K << 3, -s, -s, 5 * s * s;
    return omega_max_bound_by_gershgorin(PlainSystem(K, M), 0, std::vector<double>(2, 0.0)).omega;
  };
  CHECK(bound_with(1000) == Approx(bound_with(1)).epsilon(1e-6));
}

// The lowest and the highest frequency, by every method: exact, refused or not found, and said so.
#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "solvers/spectrum/frequencies.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace {

using FrequencyMethod = FrequencyEstimate (*)(const SemiDiscrete&, double, ConstVec, const SpectrumOptions&);

}  // namespace

TEST_CASE("every method agrees with the dense solution to 1e-8 at its default options") {
  for (const ChainOptions& options : held_chains()) {
    const Chain chain(options);
    const std::vector<double> u = at_rest(chain);
    const Eigen::VectorXd omega = dense_frequencies(chain, u);
    const double lowest = omega[0], highest = omega[omega.size() - 1];
    INFO("n = " << chain.size() << (options.consistent ? ", consistent" : ", lumped"));
    const std::vector<std::pair<FrequencyMethod, double>> cases = {{omega_max_by_power_iteration, highest},
                                                                   {omega_1_by_lanczos, lowest},
                                                                   {omega_1_by_arpack, lowest},
                                                                   {omega_max_by_arpack, highest}};
    for (const auto& [method, expected] : cases) {
      const FrequencyEstimate estimate = method(chain, 0, u, SpectrumOptions{});
      INFO(estimate.status);
      CHECK(estimate.converged);
      CHECK(estimate.omega == near(expected));
      CHECK(estimate.iterations > 0);
      CHECK(estimate.wall_s >= 0);
      CHECK_FALSE(estimate.status.empty());
    }
  }
}

TEST_CASE("the frequencies of an equal chain are the exact ones") {
  const Chain chain({.n = 200, .mass = 0.5, .stiffness = 8});
  const std::vector<double> u = at_rest(chain);
  CHECK(omega_1_by_lanczos(chain, 0, u).omega == near(chain.exact_omega(1)));
  CHECK(omega_1_by_arpack(chain, 0, u).omega == near(chain.exact_omega(1)));
  CHECK(omega_max_by_arpack(chain, 0, u).omega == near(chain.exact_omega(200)));
}

TEST_CASE("frequencies belong to the tangent at u, not to the state at rest") {
  const Chain chain({.n = 6, .cubic = 5});
  const std::vector<double> u = {0.1, 0.4, 0.5, 1, 1.1, 2};
  const Eigen::VectorXd omega = dense_frequencies(chain, u);
  REQUIRE(omega[0] > 1.01 * dense_frequencies(chain, at_rest(chain))[0]);
  CHECK(omega_1_by_lanczos(chain, 0, u).omega == near(omega[0]));
  CHECK(omega_1_by_arpack(chain, 0, u).omega == near(omega[0]));
  CHECK(omega_max_by_power_iteration(chain, 0, u).omega == near(omega[5]));
  CHECK(omega_max_by_arpack(chain, 0, u).omega == near(omega[5]));
}

TEST_CASE("a method that runs out of iterations says so") {
  const Chain chain({.n = 1000, .consistent = true});
  const SpectrumOptions few = {.tolerance = 1e-14, .max_iterations = 5};
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_max_by_arpack}) {
    const FrequencyEstimate estimate = method(chain, 0, at_rest(chain), few);
    CHECK_FALSE(estimate.converged);
    CHECK_THAT(estimate.status, Contains("> tolerance"));
  }
}

TEST_CASE("power iteration claims convergence only where its error is within the tolerance, however slow it is") {
  // The top of a long chain is crowded: the change of ω² in one iteration is far below the error that is left.
  for (const std::size_t n : {20u, 60u, 120u}) {
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const Chain chain({.n = n});
      const FrequencyEstimate estimate =
          omega_max_by_power_iteration(chain, 0, at_rest(chain), {.tolerance = tolerance, .max_iterations = 100000});
      INFO("n = " << n << ", tolerance " << tolerance << ": " << estimate.status);
      REQUIRE(estimate.converged);
      CHECK(estimate.omega <= chain.exact_omega(n) * (1 + 1e-14));  // from below
      CHECK(1 - std::pow(estimate.omega / chain.exact_omega(n), 2) < tolerance);
    }
  }
}

TEST_CASE("a free chain still has its omega_max") {
  const Chain chain({.n = 10, .left_held = false});
  const Eigen::VectorXd omega = dense_frequencies(chain, at_rest(chain));
  CHECK(omega_max_by_power_iteration(chain, 0, at_rest(chain)).omega == near(omega[9]));
  CHECK(omega_max_by_arpack(chain, 0, at_rest(chain)).omega == near(omega[9]));
}

TEST_CASE("a tangent that is not finite gives no frequency") {
  const Chain chain({.n = 5, .cubic = 1});
  const std::vector<double> u(5, std::numeric_limits<double>::quiet_NaN());
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_1_by_arpack, omega_max_by_arpack}) {
    const FrequencyEstimate estimate = method(chain, 0, u, SpectrumOptions{});
    CHECK_FALSE(estimate.converged);
    CHECK(estimate.omega == 0);
    CHECK_THAT(estimate.status, Contains("not finite"));
  }
  CHECK_FALSE(omega_max_bound_by_gershgorin(chain, 0, u).converged);
}

TEST_CASE("frequencies are the same bits in every run") {
  const Chain chain({.n = 40, .consistent = true});
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_1_by_arpack, omega_max_by_arpack}) {
    const SpectrumOptions options;
    CHECK(method(chain, 0, at_rest(chain), options).omega == method(chain, 0, at_rest(chain), options).omega);
  }
}

TEST_CASE("spectrum options out of range are refused by name") {
  CHECK(SpectrumOptions{}.validate().empty());
  CHECK_THAT((SpectrumOptions{.tolerance = 0}.validate()), Contains("tolerance"));
  CHECK_THAT((SpectrumOptions{.max_iterations = 0}.validate()), Contains("max_iterations"));
  const Chain chain;
  for (const auto method : {omega_max_by_power_iteration, omega_1_by_lanczos, omega_1_by_arpack}) {
    CHECK_THROWS_AS(method(chain, 0, at_rest(chain), {.tolerance = -1}), std::invalid_argument);
  }
}

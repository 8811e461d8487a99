// Lanczos' method.
#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "solvers/spectrum/frequencies.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("Lanczos' method with a tolerance is above omega_max by no more than that, or says that it is not there") {
  for (const ChainOptions& options : held_chains()) {
    const Chain chain(options);
    const std::vector<double> u = at_rest(chain);
    const double exact = dense_frequencies(chain, u).maxCoeff();
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const FrequencyEstimate estimate = omega_max_by_lanczos(chain, 0, u, 400, tolerance);
      INFO("n = " << chain.size() << ", tolerance " << tolerance << ": " << estimate.status);
      CHECK(estimate.converged);
      CHECK(estimate.omega == Approx(exact).epsilon(1.01 * tolerance));
      CHECK(estimate.omega > exact * (1 - 1e-12));
    }
  }
  const Chain crowded({.n = 2000});  // whose highest frequencies are 1e-6 apart
  CHECK_FALSE(omega_max_by_lanczos(crowded, 0, at_rest(crowded), 40, 1e-7).converged);
  CHECK(omega_max_by_lanczos(crowded, 0, at_rest(crowded), 40).converged);
}

TEST_CASE("Lanczos finds omega_max to 1 % by twelve applications of K", "[strategies]") {
  for (const bool consistent : {false, true}) {
    for (const std::size_t n : {5, 40, 156, 1000}) {
      Chain chain({.n = n, .right_held = true, .consistent = consistent});
      const std::vector<double> rest(n);
      const FrequencyEstimate bound = omega_max_by_lanczos(chain, 0, rest);
      const double exact = omega_max_by_arpack(chain, 0, rest).omega;
      CAPTURE(n, consistent, bound.status);
      CHECK(bound.omega == Approx(exact).epsilon(0.01));
      CHECK(bound.iterations <= 12);
    }
  }
}

TEST_CASE("Lanczos' method shows its mode, that of the lowest frequency") {
  const Chain chain({.n = 30});
  const std::vector<double> mode = omega_1_by_lanczos(chain, 0, at_rest(chain)).mode;
  REQUIRE(mode.size() == chain.size());
  for (std::size_t i = 0; i < mode.size(); ++i) {
    const double angle = std::numbers::pi / 2 * static_cast<double>(i + 1) / (static_cast<double>(mode.size()) + 0.5);
    CHECK(std::abs(mode[i] / mode.back()) ==
          Approx(std::sin(angle) / std::sin(std::numbers::pi / 2 * 30 / 30.5)).margin(1e-3));
  }
}

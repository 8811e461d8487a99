// Chebyshev's semi-iteration.
#include <catch2/catch.hpp>

#include "solvers/relaxation/relaxing.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("Chebyshev's semi-iteration costs the Chebyshev estimate, 726 evaluations to 1e-6 at kappa = 9989",
          "[strategies]") {
  const Chain chain(long_chain());
  const long cost = evaluations_of(
      chain, {.strategy = "chebyshev", .step_fraction = 1, .options = {.omega_1 = chain.exact_omega(1)}});
  CHECK(cost == Approx(726).epsilon(0.05));
  CHECK(static_cast<double>(cost) < 1.01 * lower_bound(9989, 1e-6));
}

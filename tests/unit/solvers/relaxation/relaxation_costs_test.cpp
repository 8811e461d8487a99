// Force evaluations to 1e-6 on a chain of condition number 9989 under a uniform load.
#include <cmath>

#include <catch2/catch.hpp>

#include "solvers/relaxation/relaxing.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("leapfrog with c = 2 omega_1 at 0.9 of the critical step costs 927 evaluations to 1e-6", "[strategies]") {
  const Chain chain(long_chain());
  CHECK(evaluations_of(chain, {.strategy = "viscous", .c = 2 * chain.exact_omega(1)}) == Approx(927).epsilon(0.05));
}

TEST_CASE("Cundall's damping with alpha = 0.2 costs about 3260 evaluations to 1e-6, whatever rounding does",
          "[strategies]") {
  // D jumps with the sign of each v_i, and rounding grows to the size of the error itself in 500 steps: loads that only
  // differ in scale end up to 15 % apart.
  double sum = 0;
  const Values loads = {1, 1e-4, 1.1, 1.3, 3.7, 0.123, 0.77, 2.9, 0.31, 5.3};
  for (const double load : loads) {
    ChainOptions options = long_chain();
    options.load = load;
    const auto cost = static_cast<double>(evaluations_of(Chain(options), {.strategy = "cundall"}));
    CHECK(cost == Approx(3260).epsilon(0.25));
    sum += cost;
  }
  CHECK(sum / static_cast<double>(loads.size()) == Approx(3260).epsilon(0.12));
}

TEST_CASE("every other strategy costs what it did when it was written, to 5 %", "[strategies]") {
  const Chain chain(long_chain());
  const auto costs = [&](const Way& way) { return evaluations_of(chain, way); };
  CHECK(costs({.strategy = "adaptive"}) == Approx(942).epsilon(0.05));
  CHECK(costs({.strategy = "adaptive", .options = {.quotient = Quotient::diagonal}}) == Approx(937).epsilon(0.05));
  CHECK(costs({.strategy = "papadrakakis"}) == Approx(850).epsilon(0.05));
  CHECK(costs({.strategy = "fire"}) == Approx(612).epsilon(0.05));
  CHECK(costs({.strategy = "fire2"}) == Approx(640).epsilon(0.05));
  CHECK(costs({.strategy = "nesterov"}) == Approx(980).epsilon(0.05));
  CHECK(costs({.strategy = "combined", .step_fraction = 0.9 / std::sqrt(1.8), .alpha = 0.8}) ==
        Approx(4816).epsilon(0.05));
}

TEST_CASE("conjugate gradients end after 78 steps of two evaluations: the load meets 78 of the chain's 156 modes",
          "[strategies]") {
  const Chain chain(long_chain());
  CHECK(evaluations_of(chain, {.strategy = "cg"}, 1e-9) == Approx(157).margin(3));
  CHECK(evaluations_of(chain, {.strategy = "lbfgs"}, 1e-6) < 350);
}

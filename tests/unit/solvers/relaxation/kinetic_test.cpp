// Kinetic damping: with leapfrog at the peak that its steps show, with ARKODE at the one that root finding shows.
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "solvers/relaxation/relaxing.hpp"
#include "way_to_rest.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("kinetic damping with the half-step correction costs 309 evaluations to 1e-6 on the uniform load",
          "[strategies]") {
  const Chain chain(long_chain());
  CHECK(evaluations_of(chain, {.strategy = "kinetic"}) == Approx(309).epsilon(0.05));
}

TEST_CASE("the parabolic place of the peak takes another third off", "[strategies]") {
  const Chain chain(long_chain());
  const long half_step = evaluations_of(chain, {.strategy = "kinetic"});
  const long parabolic = evaluations_of(chain, {.strategy = "kinetic", .options = {.peak = Peak::parabolic}});
  CHECK(parabolic == Approx(211).epsilon(0.05));
  CHECK(static_cast<double>(parabolic) < 0.7 * static_cast<double>(half_step));
}

TEST_CASE("kinetic damping by ARKODE's root finding relaxes to the static solution, with fixed and adaptive steps",
          "[strategies]") {
  Chain chain({.n = 20, .cubic = 0.2, .right_held = true, .load = 0.01});
  const Values solution = static_solution(chain);
  for (const std::string method : {"erk:rk4", "erk:sofroniou-spaletta-5-3-4", "erk:fehlberg-6-4-5"}) {
    CAPTURE(method);
    const long cost = evaluations_to(1e-8, chain, solution, 2, {.strategy = "kinetic", .method = method}, 20'000);
    CHECK(cost < 20'000);
    if (method != "erk:rk4") continue;
    // Without the halts the motion would go on for ever.
    CHECK(evaluations_to(1e-8, chain, solution, 2, {.strategy = "none", .method = method}, 20'000) > 20'000);
  }
  const Summary adaptive =
      run(scenes::load("neo_hookean_bar", {"damping.strategy=kinetic", "integrator.method=erk:dormand-prince-7-4-5",
                                           "integrator.rtol=1e-5", "stop.residual=1e-8"}));
  CAPTURE(adaptive.reason);
  CHECK(adaptive.status == RunStatus::equilibrium);
  REQUIRE(adaptive.error);
  CHECK(adaptive.error->u_rel_l2 < 1e-6);
}

TEST_CASE("ARKODE halts the motion where its kinetic energy is largest: an oscillator stops at its rest position",
          "[strategies]") {
  Chain chain({.n = 1, .load = 1});
  Relaxing relaxing(chain, {.strategy = "kinetic", .method = "erk:rk4"}, 0.05);
  double t = 0;
  do t = relaxing.step().t;
  while (relaxing.y[1] != 0 && t < 10);
  CHECK(t == Approx(std::numbers::pi / 2).epsilon(1e-5));  // u = 1 − cos t
  CHECK(relaxing.y[0] == Approx(1).epsilon(1e-5));
}

// An adaptive explicit Runge–Kutta method near equilibrium: the error control lets the step grow past the stability
// limit, where it excites the high modes that damping then has to take out again.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;

TEST_CASE(
    "adaptive Runge-Kutta steps at rtol 1e-3 reach 1e-8 of equilibrium under the stability cap and stall "
    "without it") {
  for (const std::string method : {"erk:dormand-prince-7-4-5", "erk:bogacki-shampine-4-2-3", "erk:cash-karp-6-4-5"}) {
    std::vector<std::string> set = {"damping.strategy=viscous", "damping.c=critical", "integrator.method=" + method,
                                    "stop.residual=1e-8", "stop.steps=5000"};
    set.push_back("integrator.rtol=1e-3");
    const Summary capped = run(scenes::bar(set));
    set.pop_back();
    CAPTURE(method, capped.reason);
    CHECK(capped.status == RunStatus::equilibrium);
    CHECK(capped.residual <= 1e-8);
    CHECK(scenes::probe(capped, "p12", "u") == Approx(0.001 * 115.0 / 12).epsilon(1e-6));

    // What such a run does in 5000 steps hangs on its rounding: once in a while one hits the equilibrium by chance.
    set.insert(set.end(), {"integrator.step=100", "integrator.unstable_reason=to show the stall"});
    int stalls = 0;
    for (int k = 0; k < 6; ++k) {
      set.push_back(fmt::format("integrator.rtol=1.000000{}e-3", k));
      const Summary uncapped = run(scenes::bar(set));
      stalls += uncapped.status == RunStatus::step_limit && uncapped.residual > 1e-5 ? 1 : 0;
      set.pop_back();
    }
    CHECK(stalls >= 4);
  }
}

// The critical step is a promise: steps of 0.98 of it come to rest, on a plane block with nodes of next to no mass.
#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;

namespace {

struct Way {
  std::string integrator, damping;
  double alpha = 0.7;
};

RunStatus outcome(const Way& way, const std::vector<std::string>& step) {
  std::vector<std::string> overrides = {"integrator.method=" + way.integrator, "damping.strategy=" + way.damping,
                                        "damping.alpha=" + std::to_string(way.alpha), "stop.steps=30000"};
  overrides.insert(overrides.end(), step.begin(), step.end());
  Simulation simulation(scenes::load("hard/light_nodes", overrides), {.records = false});
  return simulation.run();
}

std::vector<std::string> beyond(const std::string& fraction = "1.02") {
  return {"integrator.step_fraction=" + fraction, "integrator.unstable_reason='to see it'"};
}

}  // namespace

TEST_CASE("0.98 of the critical step comes to rest under local damping with every method that has one", "[stability]") {
  for (const Method& method : methods()) {
    // Without damping there is next to no stable step, and with it none is promised.
    if (!method.fixed_step || !(stability_limit(method.amplification, 0) > 0.5)) continue;
    for (const std::string damping : {"cundall", "one-sided"}) {
      for (const double alpha : {0.2, 0.5, 0.7, 0.9}) {
        CAPTURE(method.name, damping, alpha);
        CHECK(outcome({method.name, damping, alpha}, {"integrator.step_fraction=0.98"}) == RunStatus::equilibrium);
      }
    }
  }
}

// Combined damping halts the body so soon that a growth of 1.02 may not show before.
TEST_CASE("leapfrog and symplectic Euler diverge just beyond the critical step under every local damping",
          "[stability]") {
  for (const std::string integrator : {"leapfrog", "symplectic-euler"}) {
    for (const std::string damping : {"cundall", "one-sided", "combined"}) {
      CAPTURE(integrator, damping);
      CHECK(outcome({integrator, damping}, beyond(damping == "combined" ? "1.03" : "1.02")) == RunStatus::diverged);
      CHECK(outcome({integrator, damping}, {"integrator.step_fraction=0.98"}) == RunStatus::equilibrium);
    }
  }
}

TEST_CASE("Jameson's method diverges with local damping at the step that is stable without any", "[stability]") {
  const Scene scene = scenes::load("hard/light_nodes", {"integrator.method=erk:jameson-5-2", "damping.c=0"});
  const double step = Simulation(scene, {.records = false}).parts().model.critical_step.value();
  for (const std::string damping : {"cundall", "one-sided"}) {
    const Way way{"erk:jameson-5-2", damping};
    CHECK(outcome(way, {"integrator.step=" + std::to_string(step), beyond().back()}) == RunStatus::diverged);
    CHECK(outcome(way, {}) == RunStatus::equilibrium);
  }
}

TEST_CASE("with a consistent mass leapfrog's step is sharp under local damping as well", "[stability]") {
  for (const std::string basis : {"linear", "cubic", "hermite"}) {
    for (const std::string damping : {"cundall", "one-sided"}) {
      for (const std::string fraction : {"0.98", "1.05"}) {
        const Scene scene =
            scenes::load("hard/cut_bar", {"constants.sliver=0", "mass.kind=consistent", "grid.basis=" + basis,
                                          "damping.strategy=" + damping, "integrator.step_fraction=" + fraction,
                                          beyond().back(), "stop.steps=8000"});
        CAPTURE(basis, damping, fraction);
        const RunStatus expected = fraction < "1" ? RunStatus::equilibrium : RunStatus::diverged;
        CHECK(Simulation(scene, {.records = false}).run() == expected);
      }
    }
  }
}

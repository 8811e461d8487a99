// Bodies that nothing holds: they are named before a step is taken, with the motion that nothing resists.
#include "simulation/advice/mechanism.hpp"

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;
using Catch::Contains;

namespace {

Model block(std::vector<std::string> overrides) { return make_model(scenes::load("hard/mechanism", overrides)); }
Model few_points(std::vector<std::string> overrides) { return make_model(scenes::load("hard/few_points", overrides)); }

const std::string pinned_at_middle = "support=[{at=[1.0, 0.0], component=0}, {at=[1.0, 0.0], component=1}]";

}  // namespace

TEST_CASE("a block that can turn about a pin, under a moment, is refused by every way, and the turn is named") {
  for (const std::string way : {"damping.strategy=viscous", "damping.strategy=cundall", "damping.strategy=kinetic",
                                "damping.strategy=auto", "solve.method=cg", "solve.method=newton"}) {
    CAPTURE(way);
    CHECK_THROWS_WITH(block({way}), Contains("not held") && Contains("turns about (0, 0)") &&
                                        Contains("material point") && Contains("expected a support"));
  }
  CHECK_THROWS_WITH(block({pinned_at_middle, "body_force.value=[0.001, 0.0]"}), Contains("turns about (1, 0)"));
}

TEST_CASE("a motion that nothing resists and that no load drives is none that matters") {
  CHECK_NOTHROW(block({pinned_at_middle}));  // the weight stands over the pin
  CHECK_NOTHROW(block({"body_force.value=[0.0, 0.0]"}));
  CHECK_NOTHROW(block({"stop.residual=0", "stop.time=1"}));  // what is asked for is the motion
}

TEST_CASE("of loads that change those of the end tell whether a body is held") {
  CHECK_NOTHROW(block({"body_force.value=['0', '-0.001*(t < 5)']", "stop.time=50"}));
  CHECK_THROWS_WITH(block({"body_force.value=['0', '-0.001*(t > 5)']", "stop.time=50"}), Contains("turns about"));
}

TEST_CASE("a body with fewer material points than unknowns, loaded on what strains none of them, is refused") {
  for (const std::string basis : {"quadratic", "cubic"}) {
    CAPTURE(basis);
    CHECK_THROWS_WITH(few_points({"grid.basis=" + basis, "damping.strategy=cundall"}),
                      Contains("not held") && Contains("too few material points") && Contains("material point"));
  }
  for (const std::string law : {"hencky", "neo-hookean"}) {
    CAPTURE(law);
    CHECK_THROWS_WITH(
        make_model(scenes::load("hard/column_in_phases", {"grid.cells=1", "phase.max_motion=none", "grid.basis=cubic",
                                                          "material.soil.law=" + law, "damping.strategy=cundall"})),
        Contains("not held") && Contains("too few material points") && Contains("material point"));
  }
  // An hourglass is there as well, but the load does not drive it.
  CHECK_NOTHROW(few_points({"grid.basis=linear"}));
}

TEST_CASE("a body of finite strain that hangs from a pin is no mechanism: it comes to rest where it hangs") {
  const Model model = block({"material.block.law=hencky", "damping.strategy=cundall"});
  CHECK_FALSE(find_mechanism(*model.phase, 0, model.u));
}

TEST_CASE(
    "a large body whose stiffness nobody looked at before the run is named after a bounded effort, with status 4") {
  const Summary s =
      run(scenes::load("hard/mechanism", {"grid.cells=[160, 65]", "body.points_per_cell=4", "damping.strategy=auto",
                                          "grid.basis=linear", "stop.steps=20000"}));
  CAPTURE(s.reason);
  CHECK(s.dofs > 20'000);
  CHECK(s.status == RunStatus::failed);
  CHECK(s.exit_status == 4);
  CHECK(s.steps < 1500);
  CHECK_THAT(s.reason, Contains("turns about (0, 0)"));
}

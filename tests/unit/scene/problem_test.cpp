// A problem in a program: its choices, resolved again after a change.
#include <stillpoint/scene.hpp>
#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Contains;

TEST_CASE("an open choice takes what is found for it, and one that was asked for keeps what it was assigned") {
  Choice<int> open = Choice<int>::open(1), asked = 2;
  open.take(3, "by test");
  asked.take(3, "by test");
  CHECK(open == 3);
  CHECK_FALSE(open.is_asked());
  CHECK(open.why() == "by test");
  CHECK(asked == 2);
  CHECK(asked.why() == "asked for");
  asked.become(5);
  CHECK(asked == 5);
  CHECK(asked.asked() == 2);
  asked.take(3, "by test");
  CHECK(asked == 2);
}

TEST_CASE("a problem that is resolved again makes its open choices again, and keeps those that were asked for") {
  Problem problem = scenes::load("block");
  CHECK_FALSE(problem.phase.max_motion.is_asked());
  CHECK_FALSE(problem.phase.ends());

  MaterialSpec soil{.name = "soil", .law = "drucker-prager", .parameters = {}, .choices = {}};
  soil.parameters = {{"E", 1}, {"nu", 0.2}, {"rho", 1}, {"phi", 30}, {"psi", 0}, {"c", 1}};
  problem.materials["soil"] = soil;
  const std::string elastic = problem.bodies[0].material;
  problem.bodies[0].material = "soil";
  problem = resolve(problem);
  CHECK(problem.phase.max_motion == 0.1);
  CHECK(problem.phase.max_motion.why() == "a law remembers");

  problem.bodies[0].material = elastic;
  problem = resolve(problem);
  CHECK_FALSE(problem.phase.ends());

  problem.bodies[0].material = "soil";
  problem.phase.max_motion = PhaseSpec::never;
  problem = resolve(problem);
  CHECK_FALSE(problem.phase.ends());
}

TEST_CASE("a body that fills the grid goes on to fill it when a program makes the grid larger") {
  Problem problem = scenes::load("block", {"exact={}", "probe=[]"});
  REQUIRE(problem.bodies.at(0).max == problem.grid.max);
  problem.grid.max[1] *= 2;
  problem = resolve(problem);
  CHECK(problem.bodies[0].max == problem.grid.max);
}

TEST_CASE("what is wrong with a problem that a program has changed is told by its key") {
  Problem problem = scenes::load("bar");
  problem.supports.at(0).at = {-5};
  CHECK_THROWS_WITH(resolve(problem), Contains("support[0].at") && Contains("lies outside the grid"));
  CHECK_THROWS_AS(Simulation(problem), SceneError);
  problem.supports[0].at = {0, 0};
  CHECK_THROWS_WITH(resolve(problem), Contains("support[0].at: expected 1 coordinates, found 2"));
  problem.supports[0].at = {0};
  problem.grid.min = {0, 0};
  CHECK_THROWS_WITH(resolve(problem), Contains("grid"));
}

TEST_CASE("a value that cannot be read is reported alone, and not what its default would do") {
  CHECK(scenes::refusal("granular_column", {"body.min=[0.1, 0.1]"}) ==
        "--set body.min=[0.1, 0.1]: body.min: expected 3 values, found 2");
  CHECK(scenes::refusal("torsion", {"support[0].component=r"}) ==
        "--set support[0].component=r: support[0].component: unknown value 'r'; expected one of x, y, z");
}

TEST_CASE("a run of a changed problem is the run of a scene that says so") {
  Problem problem = scenes::load("bar", {"stop={residual=0, steps=40}"});
  problem.grid.cells = {7};
  Simulation changed(problem, {.threads = 1});
  Simulation written(scenes::load("bar", {"stop={residual=0, steps=40}", "grid.cells=7"}), {.threads = 1});
  changed.run();
  written.run();
  REQUIRE(changed.u().size() == written.u().size());
  for (std::size_t i = 0; i < changed.u().size(); ++i) CHECK(changed.u()[i] == written.u()[i]);
}

TEST_CASE("the fields of a point have a component each in two dimensions") {
  CHECK(probe_fields(1) == std::vector<std::string>{"u", "v", "strain", "stress"});
  const auto fields = probe_fields(2);
  for (const char* field : {"u.x", "u.y", "v.x", "v.y", "stress.xx", "stress.yy", "stress.zz", "stress.xy", "strain.xx",
                            "strain.xy", "strain.yx", "strain.yy", "plastic_strain", "pore_pressure",
                            "effective_stress.xx", "effective_stress.yy", "effective_stress.zz", "effective_stress.xy"})
    CHECK(std::ranges::find(fields, field) != fields.end());
  CHECK(fields.size() == 20);
}

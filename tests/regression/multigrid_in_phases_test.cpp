// A multigrid mass from phase to phase, whose unknowns come and go.
#include <stillpoint/stillpoint.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "multigrid_runs.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/setup/multigrid_mass.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

/// A block that its pressure makes shorter by several cells each way.
std::vector<std::string> pressed_block(std::vector<std::string> others) {
  others.insert(others.begin(), {"phase.max_motion=0.3", "grid.cells=[40,40]", "stop.residual=1e-8"});
  return others;
}

Simulation run(const std::vector<std::string>& set) { return test::run("block", pressed_block(set)); }

}  // namespace

TEST_CASE(
    "auto with a multigrid mass presses a block through phases to its exact stress in a third of the evaluations") {
  REQUIRE_MULTIGRID();
  Simulation lumped = run({"damping.strategy=auto", "mass.kind=lumped"}),
             multigrid = run({"damping.strategy=auto", "mass.kind=multigrid"});
  CHECK(multigrid.summary().phases > 5);
  CHECK(3 * multigrid.evaluations() < lumped.evaluations());
  // Both take phases of their own, each of which leaves an error of its quadrature.
  CHECK(std::abs(scenes::probe(multigrid.summary(), "corner", "stress.yy") + 0.3) < 2e-3);
  CHECK(std::abs(scenes::probe(multigrid.summary(), "corner", "u.y") -
                 scenes::probe(lumped.summary(), "corner", "u.y")) < 2e-3 * 0.12);
}

TEST_CASE("the cycle of multigrid is kept for a phase that it serves, and made anew for one that it does not") {
  REQUIRE_MULTIGRID();
  const auto phase = [](const char* max) {
    return make_phase(scenes::load("block", pressed_block({std::string("body.max=[") + max + "," + max + "]",
                                                           "probe=[]", "damping.strategy=auto"})));
  };
  const auto half = phase("0.5"), fewer = phase("0.475"), whole = phase("1");
  const MultigridAttempt first = next_multigrid_mass(*half, nullptr);
  REQUIRE(first.mass);
  const auto next = [&](const LagrangianPhase& one) { return next_multigrid_mass(one, first.mass.get()).mass; };
  REQUIRE((next(*half) && next(*fewer) && next(*whole)));
  CHECK(next(*half)->cycle == first.mass->cycle);
  CHECK(next(*half)->omega_max == first.mass->omega_max);
  CHECK(next(*fewer)->cycle == first.mass->cycle);  // a row of nodes is gone
  CHECK(next(*fewer)->mass.size() == fewer->size());
  CHECK(next(*whole)->cycle != first.mass->cycle);
}

TEST_CASE("phases with a multigrid mass are for auto alone, and for what does not remember") {
  REQUIRE_MULTIGRID();
  CHECK_THROWS_WITH(
      make_model(scenes::load("block", pressed_block({"mass.kind=multigrid", "damping.strategy=viscous"}))),
      Contains("mass.kind") && Contains("\"auto\""));
  CHECK_THROWS_WITH(
      make_model(scenes::load("block", pressed_block({"mass.kind=multigrid", "damping.strategy=kinetic"}))),
      Contains("mass.kind") && Contains("\"auto\""));
}

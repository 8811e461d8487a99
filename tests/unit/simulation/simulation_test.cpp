// The public Simulation: what the command, compare and a user's program step through.
#include <stillpoint/run.hpp>
#include <stillpoint/simulation.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <omp.h>

#include "free_block.hpp"
#include "largest.hpp"
#include "plan/catalogue.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace {

std::vector<double> copy_of(ConstVec values) { return {values.begin(), values.end()}; }

}  // namespace

TEST_CASE("a simulation that is stepped comes to the bits of one that is run, through many phases") {
  const Scene scene = test::free_block({"initial.v=['1 + 0.5*(x - 1.125)', 0]"});
  Simulation stepped(scene), whole(scene);
  while (!stepped.done()) stepped.step();
  whole.run();
  CHECK(stepped.phases() > 3);
  CHECK(stepped.phases() == whole.phases());
  CHECK(stepped.t() == scene.stop.time);
  CHECK(copy_of(stepped.v()) == copy_of(whole.v()));
  CHECK(copy_of(stepped.field("position")) == copy_of(whole.field("position")));
  const RunStatus end = stepped.status();
  CHECK(stepped.step() == end);  // nothing more
  CHECK(stepped.steps() == whole.steps());
}

TEST_CASE("a simulation steps to the time that it is asked for, and not past it") {
  Simulation simulation(scenes::bar(), {.records = false, .stops = false});
  CHECK(simulation.run_until(3.3) == RunStatus::running);
  CHECK(simulation.t() == 3.3);
  CHECK(simulation.step(3.4) == RunStatus::running);
  CHECK(simulation.t() == 3.4);
}

TEST_CASE("a simulation leaves OpenMP's number of threads as it found it") {
  const int before = omp_get_max_threads();
  Simulation simulation(scenes::bar(), {.threads = before + 1});
  simulation.step();
  CHECK(simulation.summary().threads == before + 1);
  CHECK(omp_get_max_threads() == before);
  run(scenes::bar({"stop.steps=3"}), {.threads = before + 2});
  CHECK(omp_get_max_threads() == before);
}

TEST_CASE("fields at the points have their shapes, and another name is refused") {
  Simulation simulation(scenes::load("footing"));
  const std::size_t P = simulation.points();
  CHECK(simulation.field("u").size() == 2 * P);
  CHECK(simulation.field("position").size() == 2 * P);
  CHECK(simulation.field("stress").size() == 4 * P);
  CHECK(simulation.field("plastic_strain").size() == P);
  CHECK_THROWS_AS(simulation.field("temperature"), std::invalid_argument);
}

TEST_CASE("every static solver runs a scene to its equilibrium with the outputs of any run") {
  for (const StaticMethodInfo& method : catalogue().static_methods) {
    const test::TemporaryFolder folder;
    const Summary s = run(scenes::load("neo_hookean_bar", {"solve.method=" + std::string(method.name)}),
                          {.out = folder.path() / "out"});
    CAPTURE(method.name, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.exit_status == 0);
    CHECK(s.method == method.name);
    CHECK(s.rhs_evaluations > 0);
    REQUIRE(s.error);
    CHECK(s.error->u_rel_l2 < 1e-4);  // the discretisation's own
    CHECK(std::filesystem::exists(folder.path() / "out" / "history.csv"));
    CHECK(std::filesystem::exists(folder.path() / "out" / "summary.json"));
  }
}

TEST_CASE("Newton's method solves under the loads of stop.time") {
  const Summary full = run(scenes::bar({"solve.method=newton"}));
  const Summary ramp = run(scenes::bar({"solve.method=newton", "force[0].value='P0*min(t/3, 1)'", "stop.time=1.5"}));
  CHECK(full.status == RunStatus::equilibrium);
  CHECK(ramp.status == RunStatus::equilibrium);
  CHECK(scenes::probe(ramp, "p12", "u") == Approx(scenes::probe(full, "p12", "u") / 2).epsilon(1e-9));
}

TEST_CASE("a static solver that comes no nearer says so and has failed") {
  const Summary s = run(scenes::bar({"solve.method=newton", "stop.residual=1e-30"}));
  CHECK(s.status == RunStatus::failed);
  CHECK(s.exit_status == 4);
  CHECK_FALSE(s.reason.empty());
}

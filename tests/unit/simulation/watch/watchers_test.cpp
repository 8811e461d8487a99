// The list of watchers, and the state of a run that they look at.
#include <stillpoint/simulation.hpp>

#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "scenes.hpp"
#include "simulation/watcher.hpp"

using namespace stillpoint;

TEST_CASE("of two watchers that end a run at the same step the first one of the list is heard") {
  const auto ends = [](const Scene& scene) {
    Simulation simulation(scene, {.records = false, .stop_test = [] { return std::string("it is enough"); }});
    simulation.run();
    return simulation.reason();
  };
  CHECK(ends(scenes::bar()) == "it is enough");
  CHECK(ends(scenes::bar({"stop.steps=1"})).starts_with("1 steps reached stop.steps"));
}

TEST_CASE("each watcher has a part of its own in a checkpoint") {
  RunState run(scenes::bar(), {.records = false});
  std::set<std::string> names;
  for (const Watched& watched : make_watchers(run)) CHECK(names.insert(watched.name).second);
  CHECK(names.size() > 5);
}

TEST_CASE("a run that is not to stop goes on, whatever its watchers see") {
  Simulation simulation(test::free_block({"stop.steps=3"}), {.records = false, .stops = false});
  for (int k = 0; k < 10; ++k) CHECK(simulation.step() == RunStatus::running);
  CHECK(simulation.reason().empty());
}

TEST_CASE("figures are measured once a state, and again when it has changed") {
  RunState run(scenes::bar(), {.records = false});
  run.begin_phase(run.model.u, run.model.v);
  const double residual = run.measured.residual();
  CHECK(residual > 0);
  CHECK(run.measured.all().residual == residual);
  while (run.motion->stepper->steps() < 10) run.t = run.motion->stepper->step(1e9).t;
  CHECK(run.measured.all().residual == residual);  // nobody has said that the state is another one
  CHECK(run.measured.last().kinetic_energy == 0);
  run.measured.discard();
  CHECK(run.measured.last().kinetic_energy == 0);
  CHECK(run.measured.all().residual != residual);
  CHECK(run.measured.last().kinetic_energy > 0);
}

TEST_CASE("a run that has failed says when, after how many steps and in which phase") {
  RunState run(test::free_block(), {.records = false});
  run.begin_phase(run.model.u, run.model.v);
  const Verdict verdict = run.failed("a point was lost");
  CHECK(verdict.ends());
  CHECK(verdict.status == RunStatus::failed);
  CHECK(verdict.reason == "at t = 0 s, after 0 steps, in phase 1: a point was lost");
}

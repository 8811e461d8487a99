// How runs of several phases end if something goes wrong.
#include <stillpoint/stillpoint.hpp>

#include <cmath>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "free_block.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;
using stillpoint::test::free_block;
using stillpoint::test::free_soil;
using stillpoint::test::lines;
using stillpoint::test::TemporaryFolder;

TEST_CASE("a material point that leaves the grid ends the run as failed, with its number, and the files are kept") {
  const TemporaryFolder folder;
  const Scene scene = free_soil({"initial.v=[0, 1]", "stop.time=2", "probe=[{name='p', point=23, fields=['u.y']}]"});
  const Summary s = run(scene, {.out = folder.path(), .threads = 1});
  CHECK(s.status == RunStatus::failed);
  CHECK(s.exit_status == 4);
  CHECK_THAT(s.reason, Catch::Contains("material point") && Catch::Contains("left the grid at y") &&
                           Catch::Contains("expected a larger grid"));
  // The upper points begin 0.3125 m below the grid's top and move by up to a tenth of a cell a phase.
  CHECK(s.t == Approx(0.325).margin(0.026));
  CHECK(s.phases > 5);
  CHECK(std::filesystem::exists(folder.path() / "summary.json"));
  CHECK(std::stod(lines(folder.path() / "history.csv").back()) == s.t);
  // What is reported is the state in which the run ended: the body moved at 1 m/s.
  CHECK(scenes::probe(s, "p", "u.y") == Approx(s.t).epsilon(1e-6));
}

TEST_CASE("a wall that no grid can follow ends the run as failed, with where it has gone") {
  const Summary s = run(scenes::load("slope", {"grid.cells=[40, 16]", "wall[1].motion='1e300'", "stop.time=0.1"}));
  CHECK(s.status == RunStatus::failed);
  CHECK_THAT(s.reason, Catch::Contains("further than a grid can follow"));
}

TEST_CASE("a phase that cannot begin ends the run as failed, with the reason, and what was written is kept") {
  const TemporaryFolder folder;
  // The block slides off the node that is held.
  const Scene scene = free_soil({"initial.v=[1, 0]", "support=[{at=[0.5, 0.25], component='y'}]", "stop.time=0.4",
                                 "output.fields_every=0.05", "probe=[{name='p', point=23, fields=['u.x']}]"});
  const Summary s = run(scene, {.out = folder.path(), .threads = 1});
  CHECK(s.status == RunStatus::failed);
  CHECK(s.exit_status == 4);
  CHECK_THAT(s.reason,
             Catch::Contains("cannot begin at t = 0.2") && Catch::Contains("no material reaches this support"));
  // Its last points leave the cell of that node at 0.1875 s, and a phase lasts 0.025 s.
  CHECK(s.t == Approx(0.2).margin(0.0126));
  const Json summary = stillpoint::test::json_of(folder.path() / "summary.json");
  CHECK(summary["status"] == "failed");
  CHECK(summary["residual"].is_null());
  CHECK(std::stod(lines(folder.path() / "history.csv").back()) == Approx(s.t).margin(0.011));  // a row each 0.01 s
  CHECK(std::filesystem::exists(folder.path() / "fields.h5"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "fields.h5.partial"));

  Simulation simulation(scene);
  CHECK(simulation.run() == RunStatus::failed);
  CHECK_THROWS_AS(simulation.field("u"), std::logic_error);
}

TEST_CASE("a cell that a phase turns inside out is whole in the next phase, and the run goes on") {
  // Two halves meet at 10 m/s in the middle of a cell, whose nodes both move by half of it.
  const std::vector<std::string> collision = {"initial.v=['5*(1 - 2*(x > 1.125))', 0]"};
  const auto crash = [&](const std::string& max_motion) {
    return run(free_soil({collision[0], "phase.max_motion=" + max_motion}), {.threads = 1});
  };
  const Summary alone = crash("none");
  CHECK(alone.status == RunStatus::diverged);
  CHECK_THAT(alone.reason, Catch::Contains("cannot be evaluated"));
  CHECK(alone.phases == 1);
  const Summary next = crash("0.9");
  CAPTURE(next.reason);
  CHECK(next.status == RunStatus::end_time);
  CHECK(next.rejected_steps > 10);  // all halvings of the step that could not be
  CHECK(next.phases >= 2);
  CHECK(std::isfinite(next.kinetic_energy));
  CHECK(*next.mass_error < 1e-14);
}

TEST_CASE("a free body without loads vibrates to the end of its run: its residual is a number") {
  const Summary s = run(free_block({"initial.v=['0.1*(x - 1.125)', 0]", "stop.time=2"}), {.threads = 1});
  CAPTURE(s.reason);
  CHECK(s.status == RunStatus::end_time);
  CHECK(s.residual > 0);
  CHECK(s.residual <= 1);
}

TEST_CASE("a point alone in a cell, next to its edge or on it, neither shortens the step nor is thrown off") {
  constexpr double h = 0.25, mass = h * h / 4 * 1000;
  for (const bool drucker_prager : {false, true}) {
    double regular_step = 0;
    for (const double from_edge : {-1.0, 1e-3, 1e-6, 1e-9, 1e-13, 0.0}) {
      CAPTURE(drucker_prager, from_edge);
      const TemporaryFolder folder;
      std::ostringstream points;
      points.precision(17);
      points << "x,y,volume\n";
      for (int k = 0; k < 64; ++k) {
        points << 1 + (k % 8 + 0.5) * h / 2 << ',' << 1 + (k / 8 + 0.5) * h / 2 << ',' << h * h / 4 << '\n';
      }
      if (from_edge >= 0) points << 2 + from_edge * h << ',' << 1.3 << ',' << h * h / 4 << '\n';
      const std::vector<std::string> overrides = {
          "grid={min=[0, 0], max=[4, 4], cells=[16, 16]}",
          "body=[{file='" + folder.write("points.csv", points.str()).string() + "', material='stuff'}]",
          "material.stuff.E=1e5",
          "initial.v=['0.5 - 0.2*(y - 1.5)', '0.3 + 0.2*(x - 1.5)']",
          "stop.time=1.5",
          "probe=[{name='alone', at=[" + std::string(from_edge < 0 ? "1.9" : "2") + ", 1.3], fields=['v.x', 'v.y']}]"};
      const Scene scene = drucker_prager ? free_soil(overrides) : free_block(overrides);
      const Model model = make_model(scene);
      if (from_edge < 0) regular_step = *model.critical_step;
      CHECK(*model.critical_step == Approx(regular_step).epsilon(0.1));  // √1.2, what light nodes are let
      const Summary s = run(scene, {.threads = 1});
      REQUIRE(s.status == RunStatus::end_time);
      CHECK(s.phases > 20);
      REQUIRE(s.mass_error);
      CHECK(*s.added_mass < 0.15);
      if (from_edge >= 0) CHECK(*s.added_mass > 0.001);
      // What is added to light nodes carries energy too: at most as much more as there is more of it.
      const double initial = 0.5 * 65 * mass * (0.5 * 0.5 + 0.3 * 0.3 + 0.2 * 0.2 * 0.5 * 0.5);
      CHECK(s.kinetic_energy < 1.2 * initial);
      CHECK(std::hypot(scenes::probe(s, "alone", "v.x"), scenes::probe(s, "alone", "v.y")) < 0.8);  // 0.7 at first
    }
  }
}

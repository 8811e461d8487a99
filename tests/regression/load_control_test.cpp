// [load]: loads of one proportion, driven by their mean displacement.
#include <stillpoint/stillpoint.hpp>

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

/// To the end, beyond the limit.
LoadFigures driven_load(const std::string& scene, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), "stop.load_growth=0");
  const Summary summary = run(scenes::load(scene, overrides));
  REQUIRE(summary.status == RunStatus::end_time);
  REQUIRE(summary.load);
  return *summary.load;
}

/// The block pulled by its top as a whole, up to a mean displacement of 0.02 and held there.
std::vector<std::string> pulled_block(std::vector<std::string> more) {
  more.insert(more.begin(), {"material.rubber.law=linear-elastic", "traction=[{face='top', value=[0.0, 0.5]}]",
                             "load={displacement='0.02*min(t/20, 1)'}", "stop={residual=0, time=60}", "probe=[]"});
  return more;
}

}  // namespace

TEST_CASE("the factor that a displacement takes is the load that has that displacement, whatever its unit") {
  // σ = E' ε in plane strain, free to the side, E' = E/(1 − ν²): for u = 0.02 of 1 with t = 0.5, λ = 0.04 E'
  for (const std::string basis : {"linear", "quadratic"}) {
    CAPTURE(basis);
    const LoadFigures load = driven_load("block", pulled_block({"grid.basis=" + basis, "body.points_per_cell=9"}));
    CHECK(load.displacement < 0.02);  // by λ P/k, of a spring about as stiff as a cell
    CHECK(load.displacement > 0.015);
    CHECK(load.factor / load.displacement == Approx(2 / (1 - 0.3 * 0.3)).epsilon(1e-4));  // what still swings
  }
}

TEST_CASE("a strip footing on clay carries Prandtl's limit load within 3 %, and no more however far it is driven") {
  const LoadFigures load = driven_load("footing_limit", {});
  CHECK(load.factor == Approx(2 + M_PI).epsilon(0.03));
  CHECK(load.largest_factor == Approx(load.factor).epsilon(0.005));
  const LoadFigures half = driven_load("footing_limit", {"load.displacement=1.5e-3*t/4"});
  CHECK(load.factor == Approx(half.factor).epsilon(0.005));
  // Without the mean dilatation the same cells carry half as much again, and ever more.
  CHECK(driven_load("footing_limit", {"phase.dilatation=points"}).factor > 1.25 * load.factor);
}

TEST_CASE("a run that asks for the limit load ends there, early, with the factor that all the rest of its way has") {
  const Summary s = run(scenes::load("footing_limit", {}));
  CHECK(s.status == RunStatus::limit_load);
  CHECK(s.exit_status == 0);
  CHECK(s.t < 2);  // of 4 s
  REQUIRE(s.load);
  CHECK(s.load->factor == Approx(driven_load("footing_limit", {}).factor).epsilon(0.005));
  CHECK(s.load->growth.value() <= 0.01);
  CHECK_THAT(s.reason, Contains("the limit load"));
}

TEST_CASE("a limit load that was asked for and is not found is no success, and the summary tells how the load grows") {
  const Summary s = run(scenes::load(
      "block", pulled_block({"stop={residual=0, time=15, load_growth=0.01}", "integrator.step_fraction=0.2"})));
  CHECK(s.status == RunStatus::end_time);
  CHECK(s.exit_status == 3);
  CHECK(s.load.value().growth.value() == Approx(1).epsilon(0.1));  // elastic; what damping bears besides
  CHECK_THAT(s.reason, Contains("no limit load: over the last fifth"));
}

// N_c = cot φ (e^{π tan φ} tan²(45° + φ/2) − 1) [Prandtl 1920]. Four points of a cell that swell alike though they are
// sheared differently carry 7 % more on this grid.
TEST_CASE("soil that dilates carries Prandtl's limit load within 1 % on cells of one point, on coarse ones too") {
  for (const auto& [phi, exact] : {std::pair(0, 2 + M_PI), std::pair(20, 14.8347)}) {
    CAPTURE(phi);
    const std::string soil = fmt::format(
        "material.clay={{law='drucker-prager', E=1e9, nu=0.3, rho=1800, phi={0}, psi={0}, c='c', cone='plane-strain'}}",
        phi);
    const LoadFigures load = driven_load(
        "footing_limit", {soil, "grid.cells=[30, 20]", "body.points_per_cell=1", "phase.dilatation=points"});
    CHECK(load.factor == Approx(exact).epsilon(0.01));
    CHECK(load.largest_factor == Approx(load.factor).epsilon(0.005));
  }
}

TEST_CASE("past the limit the factor falls with the strength of a soil that softens, and the peak is remembered") {
  const LoadFigures load =
      driven_load("footing_limit", {"material.clay={law='drucker-prager', E=1e9, nu=0.3, rho=1800, phi=0, c='c', "
                                    "c_residual=3e3, softening_strain=0.004, cone='plane-strain'}"});
  CHECK(load.largest_factor > 1.2 * load.factor);
  CHECK(load.factor > 0.3 * (2 + M_PI));  // of the residual strength, and what has not softened yet
}

TEST_CASE("loads that are not driven act as they are given: a surcharge beside the footing adds itself to its limit") {
  // N_q = 1 for φ = 0: p = N_c c + q
  const std::string surcharge = "{line=[['B', 4.0], [6.0, 4.0]], value=[0.0, '-c']}";
  const LoadFigures load = driven_load(
      "footing_limit",
      {"traction=[{line=[[0.0, 4.0], ['B', 4.0]], value=[0.0, '-c']}, " + surcharge + "]", "load.of=['traction[0]']"});
  CHECK(load.factor == Approx(2 + M_PI + 1).epsilon(0.03));
}

TEST_CASE(
    "driven loads go with the body from phase to phase, and a run that is broken off there goes on with its bits") {
  const std::vector<std::string> set = {"phase.max_motion=0.02", "load.displacement=0.2*t/0.2", "stop.time=0.2",
                                        "material.clay.E=1e6",   "checkpoint.every_steps=100",  "output.every=0.01"};
  const Scene scene = scenes::load("footing_limit", set);
  const stillpoint::test::TemporaryFolder whole, broken;
  const Summary unbroken = run(scene, {.out = whole.path()});
  REQUIRE(unbroken.phases > 3);
  CHECK(unbroken.load.value().factor > 1);
  {
    Simulation simulation(scene, {.out = broken.path()});
    while (!simulation.done() && simulation.steps() < unbroken.steps * 2 / 3) simulation.step();
  }
  const auto checkpoint = broken.path() / "checkpoint.h5";
  run(load_scene_of(checkpoint), {.out = broken.path(), .resume = checkpoint});
  CHECK((stillpoint::test::contents(whole.path() / "history.csv") ==
         stillpoint::test::contents(broken.path() / "history.csv")));
}

TEST_CASE("supports bear what is driven as well, where it acts on what they hold") {
  // A block that its own weight presses onto its base: the functions there take an eighth of it at once.
  const Summary s = run(scenes::load(
      "block", pulled_block({"traction=[]", "body_force.value=[0.0, -1.0]", "load.displacement=-1e-3*min(t/20, 1)",
                             "support=[{face='bottom', name='base'}, {face='left', kind='roller'}]"})));
  REQUIRE(s.load);
  const double weight = 1;                                                            // ρ g V
  CHECK(s.reactions.at("base")[1] == Approx(s.load->factor * weight).epsilon(1e-3));  // but for what still swings
}

TEST_CASE("a free body that loads drive has the momentum of their impulse, not that of the start") {
  const Summary s = run(scenes::load(
      "block", {"material.rubber.law=hencky", "support=[]", "probe=[]", "phase.max_motion=0.05",
                "damping.strategy=none", "traction=[{line=[[0.2, 0.4], [0.4, 0.4]], value=[0.1, 0.0]}]",
                "grid={min=[0, 0], max=[2, 1], cells=[16, 8]}", "body.min=[0.2, 0.4]", "body.max=[0.4, 0.6]",
                "load.displacement=0.3*t", "initial.v=[0.01, 0.0]", "stop={residual=0, time=1}"}));
  REQUIRE(s.phases > 3);
  REQUIRE(s.momentum_error);
  CHECK(*s.momentum_error < 1e-12);
}

TEST_CASE("what a displacement cannot drive is refused at its key") {
  CHECK_THAT(scenes::refusal("level_ground", {"load.displacement=1e-3*t", "stop.time=1"}),
             Contains("initial.geostatic") && Contains("drives it"));
  CHECK_THAT(scenes::refusal("block", pulled_block({"traction=[]"})), Contains("load") && Contains("there are none"));
  CHECK_THAT(scenes::refusal("block", pulled_block({"load.of=['traction[1]']"})),
             Contains("load.of") && Contains("traction[0]"));
  CHECK_THAT(scenes::refusal("block", pulled_block({"traction=[{face='top', value=[0.0, 't']}]"})),
             Contains("depends on t"));
  CHECK_THAT(scenes::refusal("block", pulled_block({"solve.method=newton"})), Contains("static solver"));
  CHECK_THAT(scenes::refusal("block", pulled_block({"stop.time=0"})), Contains("stop.time"));
}

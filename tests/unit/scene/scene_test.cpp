#include <stillpoint/scene.hpp>

#include <array>
#include <filesystem>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "base/text.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

const std::filesystem::path kBar = std::filesystem::path(STILLPOINT_PROBLEMS) / "bar.toml";

/// The smallest scene there is, with more text after it (or before, for keys of the top).
Scene load_smallest(const std::string& after = "", const std::string& before = "") {
  const TemporaryFolder folder;
  return load_scene(folder.write("smallest.toml", before + R"(
[grid]
min = 0
max = 2
cells = 4
[body]
material = "steel"
[material.steel]
law = "linear-elastic"
E = 2e11
rho = 7850
)" + after));
}

}  // namespace

TEST_CASE("the bar of the paper loads with the values of its file") {
  const Scene bar = load_scene(kBar);
  CHECK(bar.name == "bar");
  CHECK(bar.file == kBar);
  CHECK(bar.dim == 1);
  CHECK(bar.constants == Constants{{"P0", 0.001}, {"l", 10.0}});
  CHECK(bar.grid.min == std::vector{0.0});
  CHECK(bar.grid.max == std::vector{10.0});
  CHECK(bar.grid.cells == std::vector{4});
  CHECK(bar.grid.basis == BasisKind::hermite);
  CHECK(bar.bodies.at(0).max == std::vector{10.0});
  CHECK(bar.bodies.at(0).points_per_cell == std::vector{3});
  CHECK(bar.materials.at("bar").parameters.at("E") == 1);
  CHECK(bar.forces.at(0).value.at(0)({}, 0) == 0.001);
  CHECK(bar.damping.c == 0.45);
  CHECK(bar.stop.residual == 1e-10);
  CHECK(bar.exact.u.at(0)(std::array{10.0}, 0) == Approx(0.01));
  REQUIRE(bar.exact.stress.size() == 1);
  CHECK(bar.exact.stress[0](std::array{10.0}, 0) == 0.001);
  CHECK(bar.probes.at(1).name == "p12");
  CHECK(bar.probes.at(1).point == 12);
  CHECK(bar.probes.at(1).fields == std::vector<std::string>{"u", "stress"});
  CHECK(bar.variants.size() == 3);
}

TEST_CASE("a variant's settings can be loaded as overrides") {
  const Scene bar = load_scene(kBar);
  const Scene variant = load_scene(kBar, bar.variants.at(0).set);
  CHECK(variant.damping.c == Approx(std::numbers::pi / 10));
  CHECK(variant.stop.residual == 0);
  CHECK(variant.stop.time == 50);
}

TEST_CASE("what a scene leaves out has its default") {
  const Scene scene = load_smallest();
  CHECK(scene.title.empty());
  CHECK(scene.grid.basis == BasisKind::linear);
  CHECK(scene.bodies.at(0).min == std::vector{0.0});
  CHECK(scene.bodies.at(0).max == std::vector{2.0});
  CHECK(scene.bodies.at(0).placement == Placement::uniform);
  CHECK(scene.bodies.at(0).volumes == VolumeRule::consistent);
  CHECK(scene.bodies.at(0).points_per_cell == std::vector{2});
  CHECK(scene.materials.at("steel").parameters.at("nu") == 0);
  CHECK(scene.mass.kind == MassKind::consistent);
  CHECK(scene.damping.strategy == "viscous");
  CHECK_FALSE(scene.damping.c);
  CHECK(scene.integrator.method == "leapfrog");
  CHECK_FALSE(scene.integrator.rtol);
  CHECK(scene.stop.residual == 1e-6);
  CHECK(scene.exact.u.empty());
}

TEST_CASE("every number may be an integer, a float or a formula of the constants") {
  const Scene scene = load_smallest("[stop]\nsteps = \"10^n\"\ntime = 3\nhold = 2.5\n", "[constants]\nn = 4\n");
  CHECK(scene.stop.steps == 10000);
  CHECK(scene.stop.time == 3);
  CHECK(scene.stop.dwell == 2.5);
}

TEST_CASE("constants may be defined from each other in any order") {
  const Scene scene = load_smallest("", "[constants]\na = \"b*2\"\nb = \"c + 1\"\nc = 3\narea = \"pi*c^2\"\n");
  CHECK(scene.constants.at("a") == 8);
  CHECK(scene.constants.at("area") == Approx(9 * std::numbers::pi));
}

TEST_CASE("every load is a formula of time, and a body force of place as well") {
  const Scene scene = load_smallest(R"(
[[support]]
at = 0
u = "0.1*t"
[[traction]]
face = "left"
value = "t < 1 ? t : 1"
[body_force]
value = "-9.81*x*t"
[initial]
v = "2*x"
)");
  CHECK(scene.supports.at(0).motion({}, 2) == Approx(0.2));
  CHECK_FALSE(scene.tractions.at(0).face == Face::right);
  CHECK(scene.tractions.at(0).value.at(0)({}, 5) == 1);
  CHECK(scene.body_force.at(0)(std::array{2.0}, 1) == Approx(-19.62));
  CHECK(scene.initial_v.at(0)(std::array{2.0}, 0) == 4);
  CHECK(scene.initial_u.empty());
}

TEST_CASE("critical damping and an unstable step are for those who say so") {
  const Scene scene = load_smallest(
      "[damping]\nc = \"critical\"\n[integrator]\nstep_fraction = 1.5\nunstable_reason = \"to watch it diverge\"\n");
  CHECK_FALSE(scene.damping.c);
  CHECK(scene.integrator.step_fraction == 1.5);
}

TEST_CASE("an override replaces a value, adds a key, or makes a table") {
  CHECK(load_scene(kBar, {"damping.c=0.7"}).damping.c == 0.7);
  CHECK(load_scene(kBar, {"damping.c=pi/10"}).damping.c == Approx(std::numbers::pi / 10));
  CHECK(load_scene(kBar, {"damping.c=\"P0*2\""}).damping.c == 0.002);
  CHECK_FALSE(load_scene(kBar, {"damping.c=critical"}).damping.c);
  CHECK(load_scene(kBar, {"body.placement = gauss"}).bodies.at(0).placement == Placement::gauss);
  CHECK(load_scene(kBar, {"title=A bar, again"}).title == "A bar, again");
  CHECK(load_scene(kBar, {"body_force.value=-9.81"}).body_force.size() == 1);
  CHECK(load_scene(kBar, {"constants.P0=0.002"}).forces.at(0).value.at(0)({}, 0) == 0.002);
  CHECK(load_scene(kBar, {"probe=[]"}).probes.empty());
  CHECK(load_scene(kBar, {"damping={alpha=0.5}"}).damping.c == 0.45);
  CHECK(load_scene(kBar, {"damping.c=1", "damping.c=2"}).damping.c == 2);
}

TEST_CASE("a scene knows where each key was written") {
  const TemporaryFolder folder;
  const auto file = folder.write("bar.toml", R"([grid]
min = 0
max = 2
cells = 4
[body]
material = "steel"
[material.steel]
law = "linear-elastic"
E = 1
rho = 1
[[probe]]
name = "tip"
at = 2
fields = ["u", "v"]
)");
  const Scene scene = load_scene(file, {"body.area=2"});
  CHECK(to_string(scene.location("grid.cells")) == file.string() + ":4:9");
  CHECK(to_string(scene.location("probe[0].fields[1]")) == file.string() + ":14:16");
  CHECK(to_string(scene.location("body.area")) == "--set body.area=2");
  // What was not written lies in the nearest table that was.
  CHECK(to_string(scene.location("body.seed")) == file.string() + ":5:1");
  CHECK(to_string(scene.location("probe[0].point")) == file.string() + ":11:1");
  CHECK(to_string(scene.location("traction[0].face")) == file.string() + ":1:1");  // the file
}

TEST_CASE("a place that misses the border by rounding is moved onto it") {
  const Scene scene = load_smallest("[[support]]\nat = \"2*(0.1 + 0.2)/0.3\"\n");
  CHECK(scene.supports.at(0).at == std::vector{2.0});
}

TEST_CASE("the nearest word is found across a slip, and none is made up") {
  const std::vector<std::string> words = {"viscous", "identity", "cundall", "E", "rho"};
  CHECK(nearest("viscos", words) == "viscous");
  CHECK(nearest("Identity", words) == "identity");
  CHECK(nearest("roh", words) == "rho");
  CHECK(nearest("e", words) == "E");
  CHECK(nearest("u", words).empty());
  CHECK(nearest("mushroom", words).empty());
  CHECK(nearest("", words).empty());
  CHECK(nearest(std::string(100000, 'a'), words).empty());
}

TEST_CASE("an override of the step replaces the file's fraction of the critical one, and the other way round") {
  const Scene fixed = load_scene(STILLPOINT_PROBLEMS "/bar.toml", {"integrator.step=0.01"});
  CHECK(fixed.integrator.step == 0.01);
  const Scene fraction =
      load_scene(STILLPOINT_PROBLEMS "/bar.toml", {"integrator.step=0.01", "integrator.step_fraction=0.5"});
  CHECK_FALSE(fraction.integrator.step);
  CHECK(fraction.integrator.step_fraction == 0.5);
}

TEST_CASE("an override that a variant could not take is no fault of the scene") {
  CHECK(load_scene(STILLPOINT_PROBLEMS "/bar.toml", {"integrator.damping=lagged"}).integrator.treatment ==
        DampingTreatment::lagged);
}

TEST_CASE("an override reaches into an array of tables by index") {
  const Scene scene = load_scene(STILLPOINT_PROBLEMS "/bar.toml", {"force[0].value=0.002", "probe[1].name=tip"});
  CHECK(scene.forces[0].value[0]({}, 0) == 0.002);
  CHECK(scene.probes[1].name == "tip");
}

TEST_CASE(
    "a scene is relaxed unless it names a static solver, which leaves the file's damping and steps without effect") {
  const Scene relaxed = load_scene(kBar);
  CHECK(relaxed.solve.method == "relaxation");
  CHECK_FALSE(relaxed.solve.is_static());
  const Scene newton = load_scene(kBar, {"solve.method=newton"});
  CHECK(newton.solve.method == "newton");
  CHECK(newton.solve.is_static());
  CHECK_FALSE(newton.damping.c);
  CHECK_THROWS_AS(load_scene(kBar, {"solve.method=newton", "damping.c=1"}), SceneError);
}

TEST_CASE("a static solver takes loads of time as they are at stop.time, if it can take them at all") {
  const std::vector<std::string> growing = {"force[0].value=\"P0*t\"", "stop.time=2"};
  const auto with = [&](const char* method) {
    std::vector<std::string> overrides = growing;
    overrides.push_back(std::string("solve.method=") + method);
    return overrides;
  };
  CHECK(load_scene(kBar, with("newton")).stop.time == 2);
  CHECK_THROWS_AS(load_scene(kBar, with("cg")), SceneError);
}

TEST_CASE("a law that keeps history brings no phases to a static solver") {
  const auto footing = std::filesystem::path(STILLPOINT_PROBLEMS) / "footing.toml";
  CHECK(load_scene(footing, {"solve.method=newton", "phase={}"}).phase.max_motion == PhaseSpec::never);
  CHECK(load_scene(footing, {"solve.method=newton"}).phase.max_motion == PhaseSpec::never);
}

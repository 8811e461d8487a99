// Scenes of two dimensions: every key once, defaults, and what --set changes.
#include <stillpoint/scene.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scene/little_block.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::load_block;
using stillpoint::test::TemporaryFolder;

namespace {

/// A slope behind a wall, with overrides.
Scene load_slope(const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  return load_scene(folder.write("slope.toml", R"(
dim = 2
[grid]
min = [0, 0]
max = [6, 4]
cells = [12, 8]
basis = "cubic"
follow = "wall"
[body]
min = [0, 0]
max = [6, 3]
material = "soil"
state = "plane-strain"
thickness = 2
points_per_cell = [3, 2]
placement = "gauss"
jitter = 0.25
volumes = "equal"
seed = 7
[material.soil]
law = "drucker-prager"
E = 1e7
nu = 0.3
rho = 1600
phi = 35
psi = 5
c = 100
cone = "mean"
[mass]
kind = "lumped"
scaling = 25
[phase]
max_motion = 0.2
max_strain = 0.05
transfer = "xpic"
xpic_order = 3
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
u = 0
[[support]]
at = [6, 4]
component = 1
[[wall]]
name = "wall"
face = "right"
motion = "0.05*t"
friction = 0.3
[[traction]]
face = "top"
value = ["t", -1000]
[[traction]]
face = "left"
pressure = "50*t"
[body_force]
value = [0, -9.81]
[initial]
v = ["y", "-x"]
[initial.geostatic]
K0 = 0.43
surface = 3
[output]
every = 0.5
stages = [0, "1/2", 2]
fields_every = 4
[[probe]]
name = "slope"
kind = "slope_angle"
[[probe]]
name = "crest"
at = [6, 3]
fields = ["u.x", "v.y", "stress.zz", "strain.yx", "plastic_strain"]
)"),
                    overrides);
}

}  // namespace

TEST_CASE("a plane scene loads with every key that it says") {
  const Scene scene = load_slope();
  CHECK(scene.dim == 2);
  CHECK(scene.state == StressState::plane_strain);
  CHECK(scene.grid.max == std::vector{6.0, 4.0});
  CHECK(scene.grid.cells == std::vector{12, 8});
  CHECK(scene.grid.basis == BasisKind::cubic);
  CHECK(scene.grid.follow == "wall");

  const BodySpec& body = scene.bodies.at(0);
  CHECK(body.min == std::vector{0.0, 0.0});
  CHECK(body.max == std::vector{6.0, 3.0});
  CHECK(body.area == 2);
  CHECK(body.points_per_cell == std::vector{3, 2});
  CHECK(body.placement == Placement::gauss);
  CHECK(body.jitter == 0.25);
  CHECK(body.volumes == VolumeRule::equal);
  CHECK(body.seed == 7);
  CHECK(scene.materials.at("soil").parameters.at("psi") == 5);
  CHECK(scene.materials.at("soil").choices.at("cone") == "mean");
  CHECK(scene.materials.at("soil").parameters.at("phi_residual") == 35);  // as phi, if nothing else is said
  CHECK(scene.materials.at("soil").parameters.at("fluidity") == 0);

  CHECK(scene.mass.kind == MassKind::lumped);
  CHECK(scene.mass.scaling == MassScaling::uniform);
  CHECK(scene.mass.factor == 25);
  CHECK(scene.phase.max_motion == 0.2);
  CHECK(scene.phase.max_strain == 0.05);
  CHECK(scene.phase.transfer == Transfer::xpic);
  CHECK(scene.phase.xpic_order == 3);

  CHECK(scene.supports.at(0).face == Face::bottom);
  CHECK(scene.supports.at(0).at.empty());
  CHECK_FALSE(scene.supports.at(0).holds_one_component());
  CHECK(scene.supports.at(0).component == 1);  // its normal
  CHECK(scene.supports.at(1).face == Face::left);
  CHECK(scene.supports.at(1).holds_one_component());
  CHECK(scene.supports.at(1).component == 0);
  CHECK(load_block("[[support]]\nface = \"left\"\nu = \"0.1*t\"\n").supports.at(0).motion({}, 2) == Approx(0.2));
  CHECK_FALSE(scene.supports.at(2).face);
  CHECK(scene.supports.at(2).at == std::vector{6.0, 4.0});
  CHECK(scene.supports.at(2).component == 1);

  CHECK(scene.walls.at(0).name == "wall");
  CHECK(scene.walls.at(0).face == Face::right);
  CHECK(scene.walls.at(0).motion({}, 2) == Approx(0.1));
  CHECK(scene.walls.at(0).friction == 0.3);
  CHECK(scene.tractions.at(0).face == Face::top);
  CHECK(scene.tractions.at(0).value.at(0)({}, 3) == 3);
  CHECK(scene.tractions.at(0).value.at(1)({}, 3) == -1000);
  CHECK_FALSE(scene.tractions.at(0).pressure);
  CHECK(scene.tractions.at(1).value.empty());
  REQUIRE(scene.tractions.at(1).pressure);
  CHECK((*scene.tractions.at(1).pressure)({}, 2) == 100);
  CHECK(scene.body_force.at(1)({}, 0) == -9.81);
  CHECK(scene.initial_v.at(1)(std::array{2.0, 5.0}, 0) == -2);
  REQUIRE(scene.geostatic);
  CHECK(scene.geostatic->K0({}, 0) == 0.43);
  CHECK(scene.geostatic->surface == 3);

  CHECK(scene.output.every == 0.5);
  CHECK(scene.output.snapshots == std::vector{0.0, 0.5, 2.0});
  CHECK(scene.output.fields_every == 4);
  CHECK(scene.probes.at(0).kind == ProbeKind::slope_angle);
  CHECK(scene.probes.at(0).fields.empty());
  CHECK(scene.probes.at(1).kind == ProbeKind::point);
  CHECK(scene.probes.at(1).at == std::vector{6.0, 3.0});
  CHECK(scene.probes.at(1).fields.size() == 5);
}

TEST_CASE("what a plane scene leaves out has its default") {
  const Scene scene = load_block();
  CHECK(scene.state == StressState::plane_strain);
  CHECK(scene.grid.follow.empty());
  CHECK(scene.bodies.size() == 1);
  CHECK(scene.bodies.at(0).min == std::vector{0.0, 0.0});
  CHECK(scene.bodies.at(0).max == std::vector{2.0, 1.0});
  CHECK(scene.bodies.at(0).area == 1);
  CHECK(scene.bodies.at(0).points_per_cell == std::vector{2, 2});
  CHECK(scene.bodies.at(0).jitter == 0);
  CHECK(scene.mass.kind == MassKind::lumped);
  CHECK(scene.mass.factor == 1);
  CHECK(scene.phase.max_motion == PhaseSpec::never);
  CHECK_FALSE(scene.phase.max_strain);
  CHECK(scene.phase.transfer == Transfer::flip);
  CHECK(scene.phase.flip_share == 1);
  CHECK_FALSE(scene.geostatic);
  CHECK(scene.output.snapshots.empty());
  const Scene walled = load_block("[[wall]]\nname = \"lid\"\nface = \"top\"\n");
  CHECK(walled.walls.at(0).friction == 0);
  CHECK(walled.walls.at(0).motion({}, 1) == 0);
}

TEST_CASE("a law that keeps history brings phases of a tenth of a cell, unless the scene says otherwise") {
  CHECK(load_block("", "", "drucker-prager").phase.max_motion == 0.1);
  CHECK(load_block("", "", "drucker-prager").materials.at("rubber").choices.at("cone") == "plane-strain");
  CHECK(load_block("[phase]\nmax_motion = \"none\"\n", "", "drucker-prager").phase.max_motion == PhaseSpec::never);
  CHECK(load_block("[phase]\nmax_motion = 0\n", "", "drucker-prager").phase.max_motion == 0);
  CHECK(load_block("", "", "neo-hookean").phase.max_motion == PhaseSpec::never);
  CHECK(load_block("", "", "linear-elastic").phase.max_motion == PhaseSpec::never);
}

TEST_CASE("the number of points in a plane cell is a square, or two numbers") {
  CHECK(load_slope({"body.points_per_cell=9"}).bodies.at(0).points_per_cell == std::vector{3, 3});
  CHECK(load_slope({"body.points_per_cell=1"}).bodies.at(0).points_per_cell == std::vector{1, 1});
  CHECK(load_slope({"body.points_per_cell=[1, 4]"}).bodies.at(0).points_per_cell == std::vector{1, 4});
  CHECK_THROWS_AS(load_slope({"body.points_per_cell=8"}), SceneError);
}

TEST_CASE("an override reaches every key of a plane scene") {
  CHECK(load_slope({"mass.scaling=4"}).mass.factor == 4);
  const Scene bounded = load_slope({"mass.scaling=gershgorin"});
  CHECK(bounded.mass.scaling == MassScaling::gershgorin);
  CHECK(bounded.mass.factor == 1);
  CHECK(load_slope({"phase.max_motion=0"}).phase.max_motion == 0);
  CHECK(load_slope({"phase.max_motion=none"}).phase.max_motion == PhaseSpec::never);
  CHECK(load_slope({"material.soil.cone=plane-strain"}).materials.at("soil").choices.at("cone") == "plane-strain");
  CHECK(load_slope({"material.soil.phi=40"}).materials.at("soil").parameters.at("phi") == 40);
  CHECK(load_slope({"damping.alpha=0.2"}).damping.alpha == 0.2);
  CHECK(load_slope({"damping.strategy=one-sided"}).damping.strategy == "one-sided");
  CHECK(load_slope({"wall[0].motion=0.1*t"}).walls.at(0).motion({}, 1) == 0.1);
  CHECK(load_slope({"wall[0].motion=\"0.1*t\""}).walls.at(0).motion({}, 1) == 0.1);
  CHECK(std::isinf(load_slope({"wall[0].friction=rough"}).walls.at(0).friction));
  CHECK(load_slope({"grid.cells=[24, 16]"}).grid.cells == std::vector{24, 16});
  CHECK(load_slope({"grid.basis=quadratic"}).grid.basis == BasisKind::quadratic);
  CHECK(load_slope({"output.stages=[3]"}).output.snapshots == std::vector{3.0});
  CHECK(load_slope({"initial.geostatic.K0=0.5"}).geostatic->K0({}, 0) == 0.5);
  CHECK(load_slope({"support[1].kind=fixed"}).supports.at(1).holds_one_component() == false);
}

TEST_CASE("the component that a support holds is a number or a coordinate's name") {
  CHECK(load_slope({"support[2].component=y"}).supports.at(2).component == 1);
  CHECK(load_slope({"support[2].component=x"}).supports.at(2).component == 0);
  CHECK(load_slope({"support[2].component=0"}).supports.at(2).component == 0);
}

TEST_CASE("a transfer given by --set replaces the file's, with the keys that belong to it") {
  const Scene apic = load_slope({"phase.transfer=apic"});
  CHECK(apic.phase.transfer == Transfer::apic);
  const Scene flip = load_slope({"phase.flip_share=0.5", "phase.transfer=flip"});
  CHECK(flip.phase.transfer == Transfer::flip);
  CHECK(flip.phase.flip_share == 0.5);
  CHECK(load_slope({"phase.transfer=xpic"}).phase.xpic_order == 3);
  CHECK_THROWS_AS(load_slope({"phase.flip_share=0.5", "phase.transfer=apic"}), SceneError);
}

TEST_CASE("in one dimension faces, walls and phases are there as well") {
  const TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("bar.toml", R"(
[grid]
min = 0
max = 2
cells = 4
[body]
material = "rubber"
[material.rubber]
law = "neo-hookean"
E = 1
rho = 1
[mass]
kind = "lumped"
scaling = 2
[phase]
max_motion = 0.1
[[support]]
face = "left"
[[wall]]
name = "stop"
face = "right"
)"));
  CHECK(scene.supports.at(0).face == Face::left);
  CHECK(scene.walls.at(0).face == Face::right);
  CHECK(scene.phase.max_motion == 0.1);
}

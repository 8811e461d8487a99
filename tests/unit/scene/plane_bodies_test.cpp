// Bodies of a plane scene: points in a cell, polygons, several bodies, files of points.
#include <stillpoint/scene.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scene/little_block.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::load_block;
using stillpoint::test::TemporaryFolder;

TEST_CASE("a body may be a polygon, whose corners on grid lines but for rounding are moved onto them") {
  const Scene scene = load_block("", R"([body]
material = "rubber"
polygon = [[0, 0], ["1.5 + 1e-9", 0.25], [0.5, 1]]
)");
  const BodySpec& body = scene.bodies.at(0);
  CHECK(body.polygon == std::vector<std::vector<double>>{{0, 0}, {1.5, 0.25}, {0.5, 1}});
  CHECK(body.min == std::vector{0.0, 0.0});
  CHECK(body.max == std::vector{1.5, 1.0});
}

TEST_CASE("there may be several bodies of several materials, and one of them may say the state") {
  const Scene scene = load_block("", R"([[body]]
material = "rubber"
max = [2, 0.5]
[[body]]
material = "foam"
min = [0, 0.5]
state = "axisymmetric"
[material.foam]
law = "hencky"
E = 1e4
rho = 30
)");
  REQUIRE(scene.bodies.size() == 2);
  CHECK(scene.bodies.at(0).max == std::vector{2.0, 0.5});
  CHECK(scene.bodies.at(1).min == std::vector{0.0, 0.5});
  CHECK(scene.bodies.at(1).material == "foam");
  CHECK(scene.state == StressState::axisymmetric);
}

TEST_CASE("a file of points is found beside the scene, and its points span the body's box") {
  const TemporaryFolder folder;
  folder.write("points.csv", "x,y,volume\n0.25,0.5,0.1\n1,0.75,0.1\n");
  const auto file = folder.write("scene.toml", R"(
dim = 2
[grid]
min = [0, 0]
max = [2, 1]
cells = [4, 2]
[body]
file = "points.csv"
material = "rubber"
[material.rubber]
law = "neo-hookean"
E = 1e6
rho = 1000
)");
  const Scene scene = load_scene(file);
  CHECK(scene.bodies.at(0).file == folder.path() / "points.csv");
  CHECK(scene.bodies.at(0).min == std::vector{0.25, 0.5});
  CHECK(scene.bodies.at(0).max == std::vector{1.0, 0.75});
}

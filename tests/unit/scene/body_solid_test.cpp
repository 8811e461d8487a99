// The solid of a body, and the shape that its keys make it.
#include "scene/body_solid.hpp"

#include <stillpoint/scene.hpp>

#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "temporary_folder.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using stillpoint::test::TemporaryFolder;

namespace {

constexpr const char* octahedron_in_a_grid = R"(
dim = 3
[grid]
min = [-2, -2, -2]
max = [2, 2, 2]
cells = [4, 4, 4]
[body]
stl = "body.stl"
material = "rock"
[material.rock]
law = "linear-elastic"
E = 1
nu = 0
rho = 1
[[support]]
face = "bottom"
)";

}  // namespace

TEST_CASE(
    "the STL file of a body is read once, when its scene is checked: copies have the same solid, file or no file") {
  const TemporaryFolder folder;
  const auto file = folder.write("body.stl", binary_stl(octahedron()));
  const Scene scene = load_scene(folder.write("body.toml", octahedron_in_a_grid));
  const BodySpec& body = scene.bodies.at(0);
  const std::shared_ptr<const Solid> solid = solid_of(body);
  const Scene copy = scene;
  std::filesystem::remove(file);
  CHECK(solid_of(body) == solid);
  CHECK(solid_of(copy.bodies[0]) == solid);
  CHECK(volume_in(*solid, box_of(body)) == Approx(4.0 / 3).epsilon(1e-6));
}

TEST_CASE("a body that is given another STL file than its scene was checked with is made of that") {
  const TemporaryFolder folder;
  folder.write("body.stl", binary_stl(octahedron()));
  BodySpec body = load_scene(folder.write("body.toml", octahedron_in_a_grid)).bodies.at(0);
  body.stl = folder.path() / "no_such_file.stl";
  CHECK_THROWS_AS(solid_of(body), SceneError);
}

TEST_CASE("the keys of a body make its shape, and a box or points from a file have no solid") {
  BodySpec body;
  CHECK(body.is_box());
  CHECK(!body.has_shape());
  CHECK_THROWS_AS(solid_of(body), std::logic_error);
  body.file = "points.csv";
  CHECK(body.shape() == BodyShape::points);
  CHECK(!body.is_box());
  CHECK(!body.has_shape());
  CHECK_THROWS_AS(solid_of(body), std::logic_error);
  body.file.clear();
  body.sphere = {0, 0, 0};
  CHECK(body.shape() == BodyShape::sphere);
  CHECK(body.has_shape());
  body.min = body.max = {0, 0};
  CHECK(!is_solid(body));
  body.min = body.max = {0, 0, 0};
  CHECK(is_solid(body));
}

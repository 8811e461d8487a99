// Shapes of bodies in space that are bad input, and loads on their surfaces.
#include "robustness/broken_scene.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace {

/// A sphere in a cube of 4 m.
const std::string kGoodSolid = R"(dim = 3
[grid]
min = [0, 0, 0]
max = [4, 4, 4]
cells = [8, 8, 8]
[body]
material = "steel"
sphere = [2, 2, 2]
radius = 1.5
inner_radius = 0.5
[material.steel]
law = "linear-elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[support]]
face = "bottom"
[[traction]]
surface = "inner"
pressure = 1e-3
[stop]
residual = 1e-6
)";

std::vector<std::string> messages(const std::string& bodies, const std::string& from = "") {
  const TemporaryFolder folder;
  std::string scene = kGoodSolid;
  const auto begin = scene.find("[body]"), end = scene.find("[material");
  scene.replace(begin, end - begin, bodies);
  scene = scene.substr(0, scene.find("[[traction]]")) + from;
  std::vector<std::string> found;
  for (const Mistake& problem : problems_of(folder.write("scene.toml", scene))) found.push_back(problem.message);
  return found;
}
std::string body(const std::string& shape) { return "[[body]]\nmaterial = \"steel\"\n" + shape + "\n"; }

}  // namespace

TEST_CASE("a scene with a sphere and a pressure inside it has no problem") {
  const TemporaryFolder folder;
  for (const Mistake& problem : problems_of(folder.write("good.toml", kGoodSolid))) UNSCOPED_INFO(problem.message);
  CHECK(problems_of(folder.write("good.toml", kGoodSolid)).empty());
}

TEST_CASE("a shape that contradicts itself, or stands out of the grid, is refused at its line") {
  check_each(
      {
          {"two shapes", "radius = 1.5", "radius = 1.5\ncylinder = [[1, 1, 1], [2, 2, 2]]", "10:12",
           "does not go with sphere; a body has one shape"},
          {"no radius", "radius = 1.5\ninner_radius = 0.5\n", "", "8:10", "needs a radius"},
          {"hollow beyond itself", "inner_radius = 0.5", "inner_radius = 1.5", "10:16",
           "must be less than radius = 1.5"},
          {"out of the grid", "radius = 1.5", "radius = 2.5", "8:10",
           "reaches from -0.5 to 4.5 along x, out of the grid, 0 to 4; where it is to be cut off, give body.min"},
          {"one end", "sphere = [2, 2, 2]", "cylinder = [[2, 2, 2]]", "8:12", "must be two positions"},
          {"no axis", "sphere = [2, 2, 2]", "cylinder = [[2, 2, 2], [2, 2, 2]]", "8:12",
           "the two positions are the same"},
          {"an axis of a sphere", "radius = 1.5", "radius = 1.5\naxis = \"x\"", "10:8", "goes with polygon"},
          {"cut off all", "radius = 1.5", "radius = 1.5\nmin = [3.6, 0, 0]", "8:10", "nothing of it lies between min"},
          {"no such surface", "surface = \"inner\"", "surface = \"end\"", "19:11", "has two ends"},
          {"both", "surface = \"inner\"", "surface = \"inner\"\nface = \"left\"", "19:11",
           "give either face or surface, not both"},
          {"a face", "surface = \"inner\"", "face = \"left\"", "18:1", "there is another shape; give surface"},
      },
      kGoodSolid);
}

TEST_CASE("a polygon in space has two coordinates a corner, and is simple") {
  CHECK_THAT(messages(body("polygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]")).at(0), Contains("expected 2 coordinates"));
  CHECK_THAT(messages(body("polygon = [[0, 0], [2, 2], [1, 0], [0, 1]]")).at(0),
             Contains("its sides cross or touch at (0.5, 0.5)"));
  CHECK_THAT(messages(body("polygon = [[0, 0], [1, 0], [0, 1]]\nradius = 1")).at(0), Contains("goes with sphere"));
  CHECK_THAT(messages(body("polygon = [[0, 0], [5, 0], [0, 1]]")).at(0), Contains("reaches from 0 to 5 along x"));
  CHECK(messages(body("polygon = [[0, 0], [1, 0], [0, 1]]\nmin = [0, 0, 1]\nmax = [4, 4, 2]\naxis = \"z\"")).empty());
}

TEST_CASE("a file of triangles that is wrong is told of once, with its name or its line") {
  const TemporaryFolder folder;
  auto facets = test::octahedron();
  for (Facet& facet : facets)
    for (SpacePoint& x : facet)
      for (double& coordinate : x) coordinate += 2;
  const auto file = folder.write("body.stl", test::ascii_stl(facets));
  const auto stl = [&] { return messages(body("stl = '" + file.string() + "'")); };
  CHECK(stl().empty());
  facets.pop_back();
  folder.write("body.stl", test::ascii_stl(facets));
  REQUIRE(stl().size() == 1);
  CHECK_THAT(stl()[0], Contains("body.stl' is not closed"));
  folder.write("body.stl", "solid body\nfacet normal 0 0 0\nouter loop\nvertex 1 2 x\n");
  REQUIRE(stl().size() == 1);
  CHECK_THAT(stl()[0], Contains("expected a finite number, found 'x'"));
  std::filesystem::remove(file);
  REQUIRE(stl().size() == 1);
  CHECK_THAT(stl()[0], Contains("body.stl' there is no such file"));
}

TEST_CASE("bodies of any shape that overlap in space are refused, those that touch are not") {
  const std::string ball = body("sphere = [2, 2, 2]\nradius = 1");
  CHECK(messages(ball + body("sphere = [2, 2, 3.9]\nradius = 1\nmax = [4, 4, 4]")).size() == 1);
  CHECK(messages(ball + body("min = [2.5, 1, 1]\nmax = [4, 3, 3]")).size() == 1);
  CHECK(messages(ball + body("min = [3, 1, 1]\nmax = [4, 3, 3]")).empty());
  CHECK(messages(ball + body("sphere = [2, 2, 2]\nradius = 1.5\ninner_radius = 1")).empty());
  CHECK(messages(ball + body("cylinder = [[0.5, 0.5, 0], [0.5, 0.5, 4]]\nradius = 0.5")).empty());
  CHECK(messages(ball + body("cylinder = [[2, 2, 2.9], [2, 2, 4]]\nradius = 0.5")).size() == 1);
}

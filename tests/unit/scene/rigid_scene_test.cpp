// Rigid bodies in a scene: what their keys say, and what is said of wrong ones, at line and column.
#include <cmath>

#include "robustness/broken_scene.hpp"
#include "scene/rigid_scenes.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace stillpoint::test {
namespace {

const std::string kDisc =
    "disc = [1, 1.2]\nradius = 0.1\nmotion = [\"0\", \"-0.01*t\"]\nfriction = 0.3\nbodies = [\"block\"]";
const std::string kBall =
    "sphere = [1, 1.2, 1]\nradius = 0.1\nmotion = [\"0\", \"-0.01*t\", \"0\"]\nbodies = [\"block\"]";

std::string fault_of(const Problem& problem) {
  try {
    (void)resolve(problem);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a rigid body in the plane loads with every key that it says, and with defaults of what it leaves out") {
  const Scene scene = plane_scene(kDisc + "\nrotation = \"0.1*t\"\nabout = [1, 2]");
  REQUIRE(scene.rigid.size() == 1);
  CHECK(scene.bodies.at(0).name == "block");
  const RigidSpec& punch = scene.rigid[0];
  CHECK(punch.name == "punch");
  CHECK(punch.disc == std::vector{1.0, 1.2});
  CHECK(punch.radius == 0.1);
  CHECK(punch.motion.at(1)({}, 2) == -0.02);
  CHECK(punch.rotation.at(0)({}, 2) == 0.2);
  CHECK(punch.about == std::vector{1.0, 2.0});
  CHECK(punch.shear.friction == 0.3);
  CHECK(punch.bodies == std::vector<std::string>{"block"});

  const RigidSpec plain = plane_scene("wedge = [[1, 1], [0, 1]]\nangle = 60").rigid.at(0);
  CHECK(plain.angle == 60);
  CHECK(plain.radius == 0);
  CHECK(plain.rounding == 0);
  CHECK(plain.shear.friction == 0);
  CHECK((plain.motion.empty() && plain.rotation.empty() && plain.about.empty() && plain.bodies.empty()));
}

TEST_CASE("a rigid body in space turns by a vector of three formulas, may be rough, and may begin displaced") {
  const RigidSpec ball =
      space_scene(
          "sphere = [1, 1, 1]\nradius = 1\nrotation = [0, \"t\", \"pi/2\"]\nmotion = [0, \"1 + t\", 0]\n"
          "friction = \"rough\"")
          .rigid.at(0);
  REQUIRE(ball.rotation.size() == 3);
  CHECK(ball.rotation[1]({}, 3) == 3);
  CHECK(ball.motion.at(1)({}, 0) == 1);
  CHECK(std::isinf(ball.shear.friction));
}

TEST_CASE("local damping takes its small share in a flow that a rigid body drives") {
  const auto alpha = [](const std::string& rigid) {
    const std::string text = broken("[stop]", "[phase]\nmax_motion = 0.1\n[stop]", plane_text(rigid));
    const TemporaryFolder folder;
    return load_scene(folder.write("scene.toml", text)).damping.alpha.value();
  };
  CHECK(alpha("disc = [1, 1.2]\nradius = 0.1") == 0.7);
  CHECK(alpha("disc = [1, 1.2]\nradius = 0.1\nmotion = [0, \"-t\"]") == 0.05);
  CHECK(alpha("disc = [1, 1.2]\nradius = 0.1\nrotation = \"t\"") == 0.05);
}

TEST_CASE("a rigid body of no shape, of two, or of keys that do not go with it is refused at its line") {
  const char* const disc = "disc = [1, 1.2]\nradius = 0.1";
  check_each(
      {
          {"no shape", "disc = [1, 1.2]\nradius = 0.1\n", "", "22:1",
           "rigid[0]: needs a shape: half_plane, min and max, polygon, disc or wedge"},
          {"two shapes", disc, "disc = [1, 1.2]\nradius = 0.1\nwedge = [[0, 2], [0, 1]]", "26:9",
           "rigid[0].wedge: does not go with disc; a rigid body has one shape"},
          {"half a box besides", disc, "disc = [1, 1.2]\nradius = 0.1\nmax = [2, 2]", "24:8",
           "rigid[0].disc: does not go with min and max"},
          {"a shape of space", "disc = [1, 1.2]", "sphere = [1, 1.2]", "24:1", "unknown key 'sphere'"},
          {"no radius", "radius = 0.1\n", "", "24:8", "rigid[0].disc: needs a radius"},
          {"a negative radius", "radius = 0.1", "radius = -1", "25:10", "must be greater than 0, not -1"},
          {"no angle", "disc = [1, 1.2]", "wedge = [[1, 1.2], [0, 1]]", "24:9", "rigid[0].wedge: needs an angle"},
          {"a flat angle", disc, "wedge = [[1, 1.2], [0, 1]]\nangle = 180", "25:9",
           "rigid[0].angle: must be greater than 0 and less than 180, not 180"},
          {"an angle of a disc", disc, "disc = [1, 1.2]\nradius = 0.1\nangle = 60", "26:9",
           "rigid[0].angle: does not go with disc, but with wedge"},
          {"a rounding of a disc", disc, "disc = [1, 1.2]\nradius = 0.1\nrounding = 0.1", "26:12",
           "rigid[0].rounding: does not go with disc, but with min and max, polygon or wedge"},
          {"a radius of a half-plane", "disc = [1, 1.2]", "half_plane = [[0, 2], [0, -1]]", "25:10",
           "rigid[0].radius: does not go with half_plane, but with disc or wedge"},
          {"a corner of a box", disc, "max = [1, 2]", "22:1", "the key 'min' is missing: a box has min and max"},
          {"a box of no height", disc, "min = [0, 2]\nmax = [1, 2]", "25:11",
           "rigid[0].max[1]: must be greater than rigid[0].min[1] = 2, not 2"},
          {"one position", disc, "half_plane = [[0, 1]]", "24:14",
           "rigid[0].half_plane: must be a position and a direction, [point, normal], not 1"},
          {"no direction", disc, "half_plane = [[0, 1], [0, 0]]", "24:23",
           "rigid[0].half_plane[1]: (0, 0) is no direction"},
          {"three coordinates", disc, "half_plane = [[0, 1], [0, 0, 1]]", "24:23",
           "rigid[0].half_plane[1]: expected 2 coordinates, found 3"},
          {"two corners", disc, "polygon = [[0, 1], [1, 1]]", "24:11", "needs from 3 to 1000 corners, not 2"},
          {"no corners", disc, "polygon = []", "24:11", "rigid[0].polygon: holds nothing"},
          {"a bow", disc, "polygon = [[0, 1], [1, 2], [1, 1], [0, 2]]", "24:11",
           "rigid[0].polygon: the edges after corners 1 and 3 of the polygon meet or lie on each other"},
          {"a box rounded off", disc, "min = [0, 1]\nmax = [1, 2]\nrounding = 0.6", "26:12",
           "rigid[0].rounding: the rounding 0.6 is not between 0 and 0.5"},
          {"a polygon rounded off", disc, "polygon = [[0, 1], [1, 1], [0, 2]]\nrounding = 0.6", "25:12",
           "rigid[0].rounding: the rounding 0.6 is too large for the polygon's corner"},
          {"a shaft rounded off", disc, "wedge = [[0, 1], [0, 1]]\nangle = 60\nradius = 0.1\nrounding = 0.2", "27:12",
           "rigid[0].rounding: the rounding 0.2 is not between 0 and 0.1"},
      },
      plane_text(kDisc));
}

TEST_CASE("a motion that is none of a rigid body, and names of nothing, are refused at their line") {
  const char* const motion = "motion = [\"0\", \"-0.01*t\"]";
  check_each(
      {
          {"of the position", "-0.01*t", "-0.01*x", "26:23", "'x' cannot be used here"},
          {"not finite at the start", "\"-0.01*t\"", "\"1/t\"", "26:16",
           "rigid[0].motion[1]: is inf at t = 0; expected a finite number"},
          {"one value", motion, "motion = \"t\"", "26:10", "rigid[0].motion: expected 2 values, found 1"},
          {"two turns", motion, "rotation = [\"t\", \"t\"]", "26:12", "rigid[0].rotation: expected 1 value, found 2"},
          {"a centre elsewhere", motion, "about = [0, 0, 0]", "26:9", "rigid[0].about: expected 2 values, found 3"},
          {"negative friction", "friction = 0.3", "friction = -1", "27:12", "must be at least 0, not -1"},
          {"rough misspelt", "friction = 0.3", "friction = \"ruogh\"", "27:12", "did you mean 'rough'?"},
          {"no such body", "bodies = [\"block\"]", "bodies = [\"blok\"]", "28:11",
           "rigid[0].bodies[0]: there is no body 'blok'; did you mean 'block'?"},
          {"the same twice", "bodies = [\"block\"]", "bodies = [\"block\", \"block\"]", "28:20",
           "rigid[0].bodies[1]: 'block' is there already"},
          {"no bodies", "bodies = [\"block\"]", "bodies = []", "28:10",
           "rigid[0].bodies: names no body; leave it out to touch all"},
          {"bodies without names", "name = \"block\"\n", "", "27:11",
           "rigid[0].bodies[0]: no body has a name; give one of them name = 'block'"},
          {"no name", "name = \"punch\"\n", "", "22:1", "rigid[0]: the key 'name' is missing"},
          {"an empty name", "\"punch\"", "\"\"", "23:8", "rigid[0].name: must not be empty"},
          {"a sum of names", "\"punch\"", "\"a+b\"", "23:8", "rigid[0].name: cannot hold a comma, a quote, a + or"},
          {"a support's name", "\"punch\"", "\"base\"", "23:8", "there is a support 'base' already"},
          {"two of one name", "bodies = [\"block\"]", "[[rigid]]\nname = \"punch\"\nhalf_plane = [[0, 2], [0, -1]]",
           "29:8", "rigid[1].name: there is a rigid body 'punch' already"},
      },
      plane_text(kDisc));
}

TEST_CASE("bodies have names of their own, and rigid bodies have others than walls and probes") {
  const std::string second = "[[body]]\nname = \"block\"\nmin = [0, 1]\nmaterial = \"rubber\"\n[material.rubber]";
  CHECK_THAT(complaints(broken("[material.rubber]", second, plane_text(kDisc))),
             Contains("body[1].name: there is a body 'block' already"));
  CHECK_THAT(complaints(broken("\"block\"", "\"a+b\"", plane_text("disc = [1, 1.2]\nradius = 0.1"))),
             Contains("body[0].name: cannot hold a comma, a quote, a +"));
  CHECK_THAT(complaints(plane_text(kDisc + "\n[[wall]]\nname = \"punch\"\nface = \"top\"")),
             Contains("rigid[0].name: there is a wall 'punch' already"));
  CHECK_THAT(complaints(plane_text(kDisc + "\n[[probe]]\nname = \"punch\"\nat = [1, 1]\nfields = [\"u.x\"]")),
             Contains("rigid[0].name: there is a probe 'punch' already"));
}

TEST_CASE("in space a rigid body has other shapes, whose keys are checked likewise") {
  const char* const ball = "sphere = [1, 1.2, 1]\nradius = 0.1";
  check_each(
      {
          {"no shape", "sphere = [1, 1.2, 1]\nradius = 0.1\n", "", "22:1",
           "rigid[0]: needs a shape: half_plane, min and max, sphere, cylinder, cone or stl"},
          {"a shape of the plane", "sphere", "disc", "24:1", "unknown key 'disc'"},
          {"no radius", "radius = 0.1\n", "", "24:10", "rigid[0].sphere: needs a radius"},
          {"no length", ball, "cylinder = [[1, 1, 1], [1, 1, 1]]\nradius = 1", "24:12",
           "rigid[0].cylinder: the two positions are the same"},
          {"no direction", ball, "cone = [[1, 1, 1], [0, 0, 0]]\nangle = 60", "24:20", "(0, 0, 0) is no direction"},
          {"an edge rounded off", ball, "cylinder = [[1, 1, 1], [1, 2, 1]]\nradius = 1\nrounding = 0.7", "26:12",
           "rigid[0].rounding: the rounding 0.7 is not between 0 and 0.5"},
          {"one turn", "bodies", "rotation = \"t\"\nbodies", "27:12", "rigid[0].rotation: expected 3 values, found 1"},
          {"no file", ball, "stl = \"none.stl\"", "24:7", "none.stl' there is no such file"},
          {"a rounding of a sphere", ball, "sphere = [1, 1, 1]\nradius = 1\nrounding = 0.1", "26:12",
           "rigid[0].rounding: does not go with sphere, but with min and max, cylinder or cone"},
      },
      space_text(kBall));
}

TEST_CASE("the file of a rigid body that is wrong is told of at the rigid body, not at a body of the same number") {
  const TemporaryFolder folder;
  folder.write("open.stl", ascii_stl({octahedron()[0]}));
  const std::string text =
      space_text("half_plane = [[0, 3, 0], [0, -1, 0]]\n[[rigid]]\nname = \"b\"\nstl = \"open.stl\"");
  const auto problems = problems_of(folder.write("scene.toml", text));
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, Contains("rigid[1].stl: ") && Contains("open.stl' is not closed"));
  CHECK(problems[0].where.line == 27);
}

TEST_CASE("a rigid body that is turned about the axis of symmetry lies beside or on it, and moves along it alone") {
  const char* const disc = "disc = [0, 1.2]\nradius = 0.1";
  check_each(
      {
          {"away from the axis", "motion = [\"0\",", "motion = [\"t\",", "26:11",
           "rigid[0].motion[0]: what is turned about the axis of symmetry moves along it alone; expected 0"},
          {"a constant", "motion = [\"0\",", "motion = [0.5,", "26:11", "moves along it alone; expected 0"},
          {"a turn", "friction", "rotation = \"t\"\nfriction", "27:12", "rigid[0].rotation: would turn the axis"},
          {"a disc across it", "disc = [0", "disc = [0.05", "24:8",
           "rigid[0].disc: reaches beyond the axis of symmetry at r = 0; expected a centre on the axis"},
          {"a box across it", disc, "min = [-1, 1]\nmax = [1, 2]", "24:7",
           "reaches beyond the axis of symmetry at r = 0; expected min[0] of at least 0"},
          {"a polygon across it", disc, "polygon = [[-1, 1], [1, 1], [0, 2]]", "24:11",
           "a polygon reaches beyond the axis of symmetry"},
          {"a wedge across it", disc, "wedge = [[0.5, 1], [0, 1]]\nangle = 60", "24:9",
           "expected tip and direction on the axis, or all of the wedge beside it"},
          {"a wedge that slants across it", disc, "wedge = [[0, 1], [1, 1]]\nangle = 100", "24:9",
           "reaches beyond the axis of symmetry"},
          {"a wedge with a side on it", disc, "wedge = [[0, 1], [1, 1]]\nangle = 90", "24:9",
           "reaches beyond the axis of symmetry"},
          {"a shaft that leans towards it", disc, "wedge = [[9, 1], [-1, 9]]\nangle = 60\nradius = 0.1", "24:9",
           "reaches beyond the axis of symmetry"},
          {"nothing beside it", disc, "half_plane = [[0, 1], [1, 0]]", "24:14",
           "rigid[0].half_plane: a border at r = 0 is not beside the axis of symmetry"},
      },
      plane_text(broken("disc = [1", "disc = [0", kDisc), "axisymmetric"));
  for (const char* const shape : {"wedge = [[0.5, 1], [0, 1]]\nangle = 60\nradius = 0.4",
                                  "wedge = [[0, 1], [1, 0]]\nangle = 60", "wedge = [[1, 1], [1, 1]]\nangle = 90"})
    CHECK(complaints(plane_text(shape, "axisymmetric")) == "");
}

TEST_CASE("rigid bodies do not go with a multigrid mass, a hermite basis, or loads that a displacement drives") {
  const std::string rests = "disc = [1, 1.2]\nradius = 0.1";
  const auto said_of = [&](const std::string& keys, const std::string& rigid) {
    return complaints(broken("[stop]\nresidual = 0\ntime = 1\n", keys, plane_text(rigid)));
  };
  CHECK(said_of("[mass]\nkind = \"multigrid\"\n", rests) ==
        "mass.kind: 'multigrid' does not know the stiffness of contact yet; take \"lumped\"\n");
  CHECK_THAT(complaints(broken("cells = [4, 4]", "cells = [4, 4]\nbasis = \"hermite\"", plane_text(rests))),
             Contains("grid.basis: 'hermite' has slopes as unknowns"));
  CHECK(said_of("[load]\ndisplacement = \"t\"\n[body_force]\nvalue = [0, -1]\n[stop]\ntime = 1\n", kDisc) ==
        "load: a displacement that drives loads and contact cannot be had together yet; move rigid bodies or supports, "
        "or give the loads as formulas of t\n");
  CHECK(said_of("[solve]\nmethod = \"newton\"\n", rests + "\nfriction = 0.3") == "");
}

TEST_CASE("points in space that a rigid body would touch are refused, as nobody knows their surface") {
  const TemporaryFolder folder;
  folder.write("points.csv", "x,y,z,volume\n0.25,0.25,0.25,0.125\n");
  std::string text = space_text("sphere = [1, 1.3, 1]\nradius = 0.2");
  text.replace(text.find("max = [2, 1, 2]"), 15, "file = \"points.csv\"");
  const std::string touched = "points in space have no surface that could be touched";
  CHECK_THROWS_WITH(load_scene(folder.write("scene.toml", text)),
                    Catch::Contains("scene.toml:8:8: ") && Catch::Contains(touched));
}

TEST_CASE("in one dimension there is no rigid body") {
  const std::string text = broken("[stop]", "[[rigid]]\nname = \"punch\"\nhalf_plane = [[0, 1], [0, 1]]\n[stop]");
  CHECK(complaints(text) == "rigid[0]: there is none in a scene with dim = 1\n");
}

TEST_CASE("a rigid body that a program has changed is checked as one of a file") {
  const Problem good = plane_scene(kDisc);
  CHECK(fault_of(good) == "");
  const auto fault = [&](const auto& change) {
    Problem problem = good;
    change(problem.rigid.at(0));
    return fault_of(problem);
  };
  CHECK_THAT(fault([](RigidSpec& one) { one.motion[1] = Expression("x", {}, "x"); }),
             Contains("rigid[0].motion[1]: depends on the position, but a rigid body moves as a whole"));
  CHECK_THAT(fault([](RigidSpec& one) { one.motion.pop_back(); }),
             Contains("rigid[0].motion: expected 2 values, found 1"));
  CHECK_THAT(fault([](RigidSpec& one) {
               one.disc = {1, 2, 3};
             }),
             Contains("rigid[0].disc: expected 2 coordinates, found 3"));
  CHECK_THAT(fault([](RigidSpec& one) {
               one.sphere = {1, 2, 3};
             }),
             Contains("rigid[0].sphere: there is none in a scene with dim = 2"));
  CHECK_THAT(fault([](RigidSpec& one) { one.disc.clear(); }), Contains("rigid[0]: needs a shape"));
  CHECK_THAT(fault([](RigidSpec& one) { one.radius = -1; }), Contains("rigid[0].disc: the radius -1 is not positive"));
  CHECK_THAT(fault([](RigidSpec& one) { one.name.clear(); }), Contains("rigid[0]: the key 'name' is missing"));
  CHECK_THAT(fault([](RigidSpec& one) {
               one.rotation = {Expression("t", {}, "t")};
               one.about = {1};
             }),
             Contains("rigid[0].about: expected 2 coordinates, found 1"));
}

}  // namespace stillpoint::test

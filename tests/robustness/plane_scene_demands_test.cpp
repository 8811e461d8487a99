// What the parts of a plane scene ask of each other, and of the files that it names, is said where it is not met.
#include <stillpoint/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "broken_scene.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("a polygon whose corners need a wrong constant is not said to have none") {
  const TemporaryFolder folder;
  const std::string scene = broken("angle = 35", "angle = 35\nside = \"sid\"", kGoodPlane);
  const auto problems =
      problems_of(folder.write("bad.toml", broken("max = [8, 3]", "polygon = [[0, 0], [\"side\", 0], [0, 3]]", scene)));
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, Catch::StartsWith("constants.side: unknown name 'sid'"));
}

TEST_CASE("what the parts of a plane scene ask of each other is said at each of them") {
  const TemporaryFolder folder;
  const auto messages = [&](const std::string& scene) {
    std::vector<std::string> texts;
    for (const Mistake& problem : problems_of(folder.write("bad.toml", scene)))
      texts.push_back(std::to_string(problem.where.line) + ": " + problem.message);
    return texts;
  };
  const auto full_mass = messages(broken("scaling = 25", "kind = \"consistent\"", kGoodPlane));
  REQUIRE(full_mass.size() == 2);
  CHECK_THAT(full_mass[0], Catch::StartsWith("23: mass.kind: velocities are carried from phase to phase by a lumped"));
  CHECK_THAT(full_mass[1], Catch::StartsWith("33: wall[0]: a wall stops node by node"));

  const std::string pressed =
      broken("[body_force]", "[[traction]]\nface = \"top\"\npressure = 1\n[body_force]", kGoodPlane);
  CHECK(messages(pressed).empty());
  const auto polygon = messages(broken("max = [8, 3]", "polygon = [[0, 0], [8, 0], [0, 3]]", pressed));
  REQUIRE(polygon.size() == 1);
  CHECK_THAT(polygon[0], Catch::StartsWith("38: traction[0]: needs a scene with one body that is a box") &&
                             Catch::EndsWith("there is a polygon; give line = [from, to]"));
  const auto two =
      messages(broken("[body]", "[[body]]\nmaterial = \"sand\"\nmax = [1, 1]\n[[body]]\nmin = [1, 0]", pressed));
  REQUIRE(two.size() == 1);
  CHECK_THAT(two[0], Catch::EndsWith("there are 2 bodies; give line = [from, to]"));
}

TEST_CASE("a law that keeps history brings phases, and their demands are met or refused at what does not go") {
  const TemporaryFolder folder;
  const std::string unasked = broken("max_motion = 0.1", "", broken("follow = \"gate\"", "", kGoodPlane));
  const auto problems = problems_of(folder.write("bad.toml", unasked));
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, Catch::Contains("give grid.follow = 'gate', or phase.max_motion = \"none\""));
  CHECK(problems_of(folder.write("good.toml", unasked), {"phase.max_motion=none"}).empty());
}

TEST_CASE("five mistakes in a plane are reported at once, in the order of the file") {
  std::string scene = broken("cells = [8, 4]", "cells = [8, 0]", kGoodPlane);
  scene = broken("points_per_cell = 4", "points_per_cell = 3", scene);
  scene = broken("0.99", "2", scene);
  scene = broken("face = \"left\"", "face = \"bottom\"", scene);
  scene = broken("\"u.x\"", "\"u\"", scene);
  const TemporaryFolder folder;
  std::vector<int> lines;
  for (const Mistake& problem : problems_of(folder.write("bad.toml", scene))) lines.push_back(problem.where.line);
  REQUIRE(lines == std::vector<int>{7, 13, 27, 31, 51});
}

TEST_CASE("what is wrong with a file of points is reported at its own lines, after the scene's own mistakes") {
  const TemporaryFolder folder;
  folder.write("points.csv", "x, y, volume\n1, 1, 0.5\n1, 1, half\n9, 1, 0.5\n");
  const std::string scene = broken("max = [8, 3]\nmaterial = \"sand\"\npoints_per_cell = 4",
                                   "file = \"points.csv\"\nmaterial = \"sand\"\nseed = 3", kGoodPlane);
  std::vector<std::string> found;
  for (const Mistake& problem : problems_of(folder.write("bad.toml", scene)))
    found.push_back(std::filesystem::path(to_string(problem.where)).filename().string() + " " + problem.message);
  REQUIRE(found == std::vector<std::string>{
                       "bad.toml:13:8 body.seed: does not go with file, which holds the points and their volumes",
                       "points.csv:3:7 volume: expected a finite number, found 'half'",
                       "points.csv:4:1 x = 9 lies outside the grid, 0 to 8"});
}

TEST_CASE("a part of a linear face that ends between nodes is refused with the nodes next to it") {
  const TemporaryFolder folder;
  std::string scene = broken("basis = \"quadratic\"", "basis = \"linear\"", kGoodPlane);
  scene = broken("face = \"bottom\"", "face = \"bottom\"\nfrom = 2.3\nto = 4", scene);
  const std::vector<Mistake> problems = problems_of(folder.write("scene.toml", scene));
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message,
             Catch::Contains("support[0].from: 2.3 is no node of the grid, whose nodes are what is held; "
                             "expected 2 or 3, a quadratic or cubic basis, or a stiffness"));
}

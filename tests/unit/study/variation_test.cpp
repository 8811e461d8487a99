// What --vary takes, and what a study refines by.
#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "scene/grid_lines.hpp"
#include "scenes.hpp"
#include "study/refinement.hpp"
#include "study/setting.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;
using Words = std::vector<std::string>;

namespace {

/// What a problem becomes by these settings.
Problem after(Problem problem, const Settings& settings) {
  for (const Setting& setting : settings) setting.apply(problem);
  return problem;
}

Words names_of(const std::vector<RefinedSource>& sources) {
  Words names;
  for (const RefinedSource& source : sources) names.push_back(source.name);
  return names;
}

}  // namespace

TEST_CASE("a variation is a key and its values, which commas in arrays, tables and strings do not part") {
  const Variation plain = variation_of("grid.basis=linear, quadratic");
  CHECK(plain.key == "grid.basis");
  CHECK(plain.values == Words{"linear", "quadratic"});
  CHECK(variation_of("grid.cells=[4, 2],[8, 4]").values == Words{"[4, 2]", "[8, 4]"});
  CHECK(variation_of("a={b=[1,2], c=3},{b=[]}").values == Words{"{b=[1,2], c=3}", "{b=[]}"});
  CHECK(variation_of("a='1,2',\"[,\",x=y").values == Words{"'1,2'", "\"[,\"", "x=y"});
}

TEST_CASE("a variation without a key, with fewer than two values or with one twice is refused as it was typed") {
  for (const std::string text : {"grid.basis", "=1,2", "a=", "a=1", "a=1,", "a=,1", "a=1,,2"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(variation_of(text), Contains("--vary " + text + ": expected a key and two values or more"));
  }
  CHECK_THROWS_WITH(variation_of("a=1,2, 1"), Contains("the value 1 stands there twice"));
}

TEST_CASE("each refinement has its name, and no other name is one") {
  for (const std::string name : {"h", "points", "step", "rtol", "motion"}) {
    REQUIRE(refinement_of(name));
    CHECK(to_string(*refinement_of(name)) == name);
  }
  CHECK_FALSE(refinement_of("H"));
  CHECK_FALSE(refinement_of(""));
}

TEST_CASE("a refinement makes one quantity finer by its factor, leaves the rest, and says how --set would") {
  const Scene scene =
      test::free_block({"body.points_per_cell=[2, 3]", "integrator.step_fraction=0.5", "phase.max_motion=0.2"});
  const Settings cells = refined(scene, Refinement::h, 1.5), points = refined(scene, Refinement::points, 2);
  CHECK(texts_of(cells) == Words{"grid.cells=[14, 6]"});  // 13.5 is rounded
  CHECK(after(scene, cells).grid.cells == std::vector{14, 6});
  CHECK(after(scene, cells).bodies.at(0).points_per_cell == std::vector{2, 3});
  CHECK(texts_of(points) == Words{"body.points_per_cell=[4, 6]"});
  CHECK(after(scene, points).bodies.at(0).points_per_cell == std::vector{4, 6});
  CHECK(after(scene, points).grid.cells == std::vector{9, 4});

  CHECK(after(scene, refined(scene, Refinement::step, 4)).integrator.step_fraction == 0.125);
  CHECK(after(scene, refined(scene, Refinement::motion, 4)).phase.max_motion == 0.05);
  CHECK(texts_of(refined(scene, Refinement::step, 4)) == Words{"integrator.step_fraction=0.125"});
  Problem timed = scene;
  timed.integrator.step = 0.5, timed.integrator.rtol = 1.0 / 128;
  CHECK(after(timed, refined(timed, Refinement::step, 4)).integrator.step == 0.125);
  CHECK(after(timed, refined(timed, Refinement::rtol, 4)).integrator.rtol == 1.0 / 512);
}

TEST_CASE("where cells are unequal a refinement halves those of each piece, and the lines before stay") {
  const Words by_pieces = {"grid.x=[[0, 0.5, 3], [0.5, 2.25, 4, 3], [2.25, 2.5, 1]]", "grid.y=[[0, 1, 5, 0.25]]"};
  const Scene scene = test::free_block(by_pieces);
  CHECK(longest_mean_cell(scene.grid) == 2.5 / 8);
  const Scene finer = with(scene, refined(scene, Refinement::h, 2));
  CHECK(finer.grid.cells == std::vector{16, 10});
  CHECK(size_of(finer, Refinement::h, 0) == size_of(scene, Refinement::h, 0) / 2);
  for (const std::size_t axis : {0, 1}) {
    const std::vector<double> before = grid_lines(scene.grid, axis), now = grid_lines(finer.grid, axis);
    REQUIRE(now.size() == 2 * before.size() - 1);
    for (std::size_t k = 0; k < before.size(); ++k) CHECK(now[2 * k] == Approx(before[k]).margin(1e-14));
  }
  // What the record says gives the same grid.
  const Scene read = test::free_block(texts_of(refined(scene, Refinement::h, 2)));
  CHECK(texts_of(refined(scene, Refinement::h, 1)) == by_pieces);
  for (const std::size_t axis : {0, 1}) CHECK(grid_lines(read.grid, axis) == grid_lines(finer.grid, axis));
  // Three parts of each cell, and four of each third of it, are twelve.
  const Problem thirds = with(scene, refined(scene, Refinement::h, 3));
  const auto in_two =
      grid_lines(with(scene, refined(with(scene, refined(scene, Refinement::h, 3)), Refinement::h, 4)).grid, 1);
  const auto at_once = grid_lines(with(scene, refined(scene, Refinement::h, 12)).grid, 1);
  CHECK(thirds.grid.cells == std::vector{24, 15});
  for (std::size_t k = 0; k < at_once.size(); ++k) CHECK(in_two.at(k) == Approx(at_once[k]).margin(1e-14));
}

TEST_CASE("the size of a level is its longest cell, the share of a cell that a point has, its step, rtol or motion") {
  Problem problem = test::free_block({"grid.cells=[3, 4]", "body.points_per_cell=[2, 3]", "phase.max_motion=0.2"});
  problem.integrator.rtol = 1e-4;
  CHECK(size_of(problem, Refinement::h, 0) == 0.75);
  CHECK(size_of(problem, Refinement::points, 0) == 0.5);
  CHECK(size_of(problem, Refinement::step, 0.25) == 0.25);
  CHECK(size_of(problem, Refinement::rtol, 0) == 1e-4);
  CHECK(size_of(problem, Refinement::motion, 0) == 0.2);
}

TEST_CASE("what a problem does not have cannot be refined, and is named with what was expected") {
  const Scene scene = scenes::load("column", {"phase.max_motion=none"});
  CHECK_THROWS_WITH(refined(scene, Refinement::rtol, 2), Contains("expected integrator.rtol"));
  CHECK_THROWS_WITH(refined(scene, Refinement::motion, 2), Contains("expected phase.max_motion above 0"));
  Problem still = scene, of_file = scene;
  still.solve.method = "newton";
  CHECK_THROWS_WITH(refined(still, Refinement::step, 2), Contains("a static solver takes no steps"));
  of_file.bodies.at(0).file = "points.csv";
  CHECK_THROWS_WITH(refined(of_file, Refinement::points, 2), Contains("points of a file cannot be refined"));
}

TEST_CASE("the other sources of error are those that a scene has and no level refines, each alone") {
  const Scene rest = scenes::load("column", {"phase.max_motion=none", "stop.residual=1e-6"});
  CHECK(names_of(other_sources(rest, {Refinement::h})) == Words{"quadrature", "the relaxation's stop"});
  CHECK(names_of(other_sources(rest, {Refinement::points})) == Words{"space", "the relaxation's stop"});
  const auto stop = other_sources(rest, {Refinement::h}).back();
  CHECK(after(rest, stop.set).stop.residual == 1e-8);
  CHECK(texts_of(stop.set) == Words{"stop.residual=1e-08"});
  const Scene tight = scenes::load("column", {"phase.max_motion=none", "stop.residual=1e-11"});
  CHECK(after(tight, other_sources(tight, {Refinement::h}).back().set).stop.residual == 1e-12);  // rounding

  const Scene moving = test::free_block();  // in phases, to stop.time
  CHECK(is_transient(moving));
  CHECK_FALSE(is_transient(rest));
  CHECK(names_of(other_sources(moving, {Refinement::h})) == Words{"quadrature", "time", "phases"});
  CHECK(names_of(other_sources(moving, {Refinement::step, Refinement::motion})) == Words{"space", "quadrature"});
  CHECK(names_of(other_sources(moving, {Refinement::rtol})) == Words{"space", "quadrature", "phases"});
}

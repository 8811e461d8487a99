// What is said of a scene before it runs: only what is so.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Contains;
using stillpoint::test::TemporaryFolder;

namespace {

std::vector<std::string> notes_of(const Scene& scene) { return make_model(scene).notes; }

bool says(const std::vector<std::string>& notes, const std::string& part) {
  return std::ranges::any_of(notes, [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// A block, 3 × 2, on its base, in a grid of 4 × 2.
std::vector<std::string> block(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"grid={min=[0, 0], max=[4, 2], cells=[8, 4]}", "probe=[]",
                             "body={max=[3, 2], material='soil', points_per_cell=4}", "support=[{face='bottom'}]"});
  return more;
}
Scene block_scene(const std::vector<std::string>& more = {}) { return scenes::load("column", block(more)); }

}  // namespace

TEST_CASE("a sliver of a cell is said to shorten the critical step for the bases and masses whose step it shortens") {
  for (const char* basis : {"linear", "quadratic", "cubic", "hermite"}) {
    for (const char* kind : {"lumped", "consistent"}) {
      const auto model_of = [&](const char* length) {
        return make_model(scenes::bar({std::string("grid.basis=") + basis, std::string("mass.kind=") + kind,
                                       "grid.cells=10", std::string("body.max=") + length, "body.points_per_cell=4",
                                       "force=[]", "body_force.value=-1e-4", "probe=[]", "damping={strategy='none'}"}));
      };
      CAPTURE(basis, kind);
      const Model whole = model_of("10.0"), sliver = model_of("9.01");
      const bool shortens = sliver.omega_max > 1.5 * whole.omega_max;
      CHECK(sliver.omega_max > 0);
      CHECK(says(sliver.notes, "shortens the critical step") == shortens);
      CHECK_FALSE(says(whole.notes, "shortens the critical step"));
    }
  }
}

TEST_CASE("a sliver is not said to shorten the step where light nodes are given inertia, or nothing steps") {
  const std::string sliver = "body.max=[0.005, 2]";  // of cells that have no neighbour to take functions from
  CHECK(says(notes_of(block_scene({sliver})), "shortens the critical step"));
  CHECK_FALSE(says(notes_of(block_scene({sliver, "mass.scaling=gershgorin"})), "shortens the critical step"));
  CHECK_FALSE(says(notes_of(block_scene({sliver, "damping={strategy='auto'}"})), "shortens the critical step"));
  CHECK_FALSE(says(notes_of(block_scene({sliver, "solve.method=newton", "damping={}", "integrator={}"})),
                   "shortens the critical step"));
}

TEST_CASE("local damping of a plane body whose consistent mass couples smooth functions is said to promise no step") {
  const auto warns = [](const char* basis, const char* mass, const char* strategy) {
    return says(notes_of(scenes::load("hard/light_nodes",
                                      {std::string("grid.basis=") + basis, "body.points_per_cell=9",
                                       std::string("mass.kind=") + mass, std::string("damping.strategy=") + strategy})),
                "no step is known to be stable");
  };
  for (const char* basis : {"quadratic", "cubic"}) {
    CAPTURE(basis);
    for (const char* strategy : {"cundall", "one-sided", "combined"}) CHECK(warns(basis, "consistent", strategy));
    CHECK_FALSE(warns(basis, "consistent", "viscous"));
    CHECK_FALSE(warns(basis, "lumped", "cundall"));
  }
  CHECK_FALSE(warns("linear", "consistent", "cundall"));
}

TEST_CASE("cut cells of a sphere with too few points are told of, with as many as cells in space need") {
  const auto sphere = [](const std::string& points) {
    return notes_of(scenes::load("thick_sphere",
                                 {"grid.cells=[6, 6, 6]", "body.placement=uniform", "body.points_per_cell=" + points}));
  };
  CHECK(says(sphere("1"), "take body.placement = \"gauss\" with 8 points per cell"));
  CHECK_FALSE(says(notes_of(scenes::load("thick_sphere", {"grid.cells=[6, 6, 6]"})), "border cuts"));
}

TEST_CASE("what the points of a polygon integrate is said by where its border cuts cells, not by its volumes") {
  const std::vector<std::string> quadratic = {"grid.basis=quadratic", "body.volumes=consistent",
                                              "body.points_per_cell=9"};
  const auto of_polygon = [&](const char* corners, std::vector<std::string> more) {
    more.insert(more.begin(), quadratic.begin(), quadratic.end());
    more.push_back("body.max=[4, 2]");
    std::vector<std::string> set = block(more);
    std::erase_if(set, [](const std::string& one) { return one.starts_with("body={") || one.starts_with("body.max"); });
    set.insert(set.begin(),
               std::string("body={polygon=") + corners + ", material='soil', points_per_cell=9, volumes='consistent'}");
    return notes_of(scenes::load("column", set));
  };
  const auto slanted = of_polygon("[[0, 0], [3, 0], [2, 2], [0, 2]]", {});
  CHECK(says(slanted, "that a body's border cuts"));
  CHECK_FALSE(says(slanted, "take consistent volumes"));
  CHECK_FALSE(says(slanted, "the points integrate degree"));
  const auto on_lines = of_polygon("[[0, 0], [3, 0], [3, 2], [0, 2]]", {});
  CHECK_FALSE(says(on_lines, "border"));
  CHECK_FALSE(says(on_lines, "integrate"));
  CHECK_FALSE(says(of_polygon("[[0, 0], [3, 0], [2, 2], [0, 2]]", {"grid.basis=linear"}), "border"));
  CHECK(says(slanted, "take body.placement = \"gauss\" with 16 points per cell"));
  const std::vector<std::string> enough = {"body.placement=gauss", "body.points_per_cell=16"};
  CHECK_FALSE(says(of_polygon("[[0, 0], [3, 0], [2, 2], [0, 2]]", enough), "border"));
  CHECK(says(of_polygon("[[0, 0], [3, 0], [2, 2], [0, 2]]", {"body.placement=gauss", "body.volumes=equal"}),
             "take consistent volumes and body.placement"));
}

TEST_CASE("equal volumes are blamed where they integrate too little, and only there") {
  const std::vector<std::string> equal = {"grid.basis=quadratic", "body.volumes=equal", "body.points_per_cell=9"};
  CHECK(says(notes_of(block_scene(equal)), "take consistent volumes"));
  CHECK(says(notes_of(block_scene({"grid.basis=quadratic", "body.points_per_cell=1", "damping.c=1"})),
             "more points per cell"));
}

TEST_CASE("consistent volumes that domains take as equal are said to be, where they were asked for and would differ") {
  const auto notes = [](const char* volumes, const char* quadrature, const char* points) {
    return notes_of(scenes::load("hard/pulled_in_phases", {volumes, std::string("phase.quadrature=") + quadrature,
                                                           std::string("body.points_per_cell=") + points}));
  };
  const std::string taken = "body.volumes = \"consistent\" is taken as equal";
  CHECK(says(notes("body.volumes=consistent", "domains", "9"), taken));
  CHECK_FALSE(says(notes("body.volumes=equal", "domains", "9"), taken));
  CHECK_FALSE(says(notes("body.volumes=consistent", "points", "9"), taken));
  CHECK_FALSE(says(notes("body.volumes=consistent", "domains", "4"), taken));
}

TEST_CASE("few domains across a body are said to bend too easily, by their number") {
  const auto notes = [](const char* cells, const char* quadrature) {
    return notes_of(scenes::load("hard/pulled_in_phases",
                                 {std::string("grid.cells=") + cells, std::string("phase.quadrature=") + quadrature}));
  };
  CHECK(says(notes("[8, 4]", "domains"), "8 domains lie across the body"));
  CHECK(says(notes("[8, 4]", "domains"), "up to 1.6 % too easily"));
  CHECK_FALSE(says(notes("[8, 4]", "points"), "too easily"));
  CHECK_FALSE(says(notes("[16, 8]", "domains"), "too easily"));
  CHECK_FALSE(says(notes_of(scenes::load("hard/fast_column")), "too easily"));
}

TEST_CASE("what points from a file integrate is not told, since it is not known") {
  const TemporaryFolder folder;
  const auto file = folder.write("points.csv", "x,y,volume\n0.3,0.3,0.2\n0.6,0.3,0.2\n0.3,0.6,0.2\n0.6,0.6,0.2\n");
  const auto notes = notes_of(scenes::load(
      "column", {"grid={min=[0, 0], max=[1, 1], cells=[1, 1], basis='quadratic'}", "probe=[]", "damping.c=1",
                 "body=[{file='" + file.string() + "', material='soil'}]", "support=[{face='bottom'}]"}));
  CHECK_FALSE(says(notes, "integrate"));
}

TEST_CASE("soil that flows is said to make cells too stiff, by whichever of its points' volumes the scene keeps") {
  const auto notes_with = [](const std::string& psi, const std::string& dilatation, const std::string& points) {
    return notes_of(
        scenes::load("footing_limit", {"material.clay.phi=20", "material.clay.psi=" + psi,
                                       "phase.dilatation=" + dilatation, "body.points_per_cell=" + points}));
  };
  CHECK(says(notes_with("0", "points", "4"), "phase.dilatation = \"cells\" lets them flow"));
  CHECK_FALSE(says(notes_with("0", "cells", "4"), "carry too much"));
  // Sharing the change of volume is no remedy where points that are sheared differently swell differently.
  CHECK(says(notes_with("20", "cells", "4"), "one point a cell"));
  CHECK(says(notes_with("20", "points", "4"), "one point a cell"));
  for (const char* dilatation : {"points", "cells"})
    CHECK_FALSE(says(notes_with("20", dilatation, "1"), "carry too much"));
}

TEST_CASE("a load that loads nothing is named") {
  CHECK(says(notes_of(block_scene({"body_force.value=[0, '-g*(y > 4)']"})),
             "body_force is zero at every material point"));
  CHECK(says(notes_of(block_scene({"body_force.value=[0, 0]", "stop.time=1"})), "all the time"));
  CHECK(says(notes_of(block_scene({"force=[{at=[1, 2], value=[0, 0]}]"})), "force[0] is zero"));
  CHECK(says(notes_of(block_scene({"traction=[{face='top', pressure='0*t'}]", "stop.time=1"})), "traction[0] is zero"));
  CHECK(says(notes_of(block_scene({"body_force.value=[0, 0]", "force=[{at=[1, 0], value=[0, -1]}]"})),
             "act where supports hold"));
  CHECK_FALSE(says(notes_of(block_scene({"body_force.value=[0, '-g*(t > 0.5)*(t < 0.501)']", "stop.time=1"})), "zero"));
  CHECK_FALSE(says(notes_of(block_scene({"body_force.value=[0, '-g*(y > 1.8)*(x > 2.8)']"})), "zero"));
}

TEST_CASE("a body on which nothing acts is said to stay as it is") {
  const std::string unloaded = "body_force.value=[0, 0]", still = "the body stays as it is";
  CHECK(says(notes_of(block_scene({unloaded})), still));
  CHECK_FALSE(says(notes_of(block_scene({unloaded, "support=[{face='bottom', u=0.1}]"})), still));
  CHECK_FALSE(says(notes_of(block_scene({unloaded, "initial.v=[0, 1]"})), still));
  // A stress that nothing balances.
  const std::string soil = "material.soil={law='mohr-coulomb', E=2e7, nu=0.3, rho=2000, c=2e5, phi=25}",
                    single = "phase.max_motion=none";
  CHECK(says(notes_of(block_scene({unloaded, soil, single})), still));
  CHECK_FALSE(says(notes_of(block_scene({unloaded, soil, single, "initial.stress=[-1e4, -1e5, -1e4, 0]"})), still));
  CHECK_FALSE(says(notes_of(block_scene()), still));
}

TEST_CASE("shared changes of volume are not advised, and are told, where friction without cohesion bears the surface") {
  const auto layer = [](const std::string& c, const std::string& dilatation) {
    return notes_of(scenes::load("ladder/sliding_layer", {"material.soil.psi=0", "constants.r=1",
                                                          "material.soil.c=" + c, "phase.dilatation=" + dilatation}));
  };
  const std::string locks = "phase.dilatation = \"cells\" lets them flow", early = "would give way too early",
                    too_weak = "a factor of safety may be too small";
  const std::string little = "0", much = "'0.2*along*H'";
  CHECK(says(layer(little, "points"), early));
  CHECK(says(layer(little, "cells"), too_weak));
  CHECK(says(layer(much, "points"), locks));
  CHECK_FALSE(says(layer(much, "points"), early));
  CHECK_FALSE(says(layer(much, "cells"), too_weak));
}

TEST_CASE("a support on a face that no material reaches is named") {
  CHECK(says(notes_of(block_scene({"support=[{face='bottom'}, {face='right'}]"})), "support[1] holds nothing"));
  CHECK_FALSE(says(notes_of(block_scene()), "holds nothing"));
}

TEST_CASE("a body that falls freely is refused at once, by whatever strategy, if equilibrium is asked for") {
  for (const char* damping : {"damping={strategy='none'}", "damping={strategy='viscous', c=1.0}",
                              "damping={strategy='kinetic'}", "damping={strategy='cundall'}"}) {
    CAPTURE(damping);
    CHECK_THROWS_WITH(make_model(block_scene({"support=[]", damping})),
                      Contains("nothing holds the body along y") && Contains("falls freely"));
    CHECK_THROWS_WITH(make_model(block_scene({"support=[{face='bottom', component='x'}]", damping})),
                      Contains("nothing holds the body along y"));
  }
  CHECK_NOTHROW(make_model(block_scene({"support=[]", "damping={strategy='none'}", "stop.residual=0", "stop.time=1"})));
}

TEST_CASE("a part of the body that hangs in the air is named by one of its points") {
  const std::string two =
      "body=[{max=[1, 2], material='soil', state='plane-strain'},"
      "{min=[2, 1], max=[3, 2], material='soil'}]";
  std::vector<std::string> set = block({"damping={strategy='none'}"});
  std::erase_if(set, [](const std::string& one) { return one.starts_with("body="); });
  set.insert(set.begin(), two);
  CHECK_THROWS_WITH(make_model(scenes::load("column", set)),
                    Contains("the part of the body around material point") && Contains("along y"));
}

TEST_CASE("a free body whose loads balance, and one that leans on a wall, are no free fall") {
  const std::string pulled = "traction=[{face='top', value=[0, 1]}, {face='bottom', value=[0, -1]}]";
  const auto notes =
      notes_of(block_scene({"support=[]", "body_force.value=[0, 0]", pulled, "damping={strategy='none'}"}));
  CHECK(says(notes, "nothing holds the body along x"));
  CHECK(says(notes, "nothing holds the body along y"));
  CHECK_NOTHROW(
      make_model(block_scene({"support=[]", "wall=[{name='floor', face='bottom'}]", "damping={strategy='none'}"})));
  CHECK_THROWS_WITH(make_model(block_scene({"support=[]", "wall=[{name='floor', face='bottom'}]",
                                            "body_force.value=[0, 'g']", "damping={strategy='none'}"})),
                    Contains("falls freely"));
}

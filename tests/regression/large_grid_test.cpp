// A body in a grid that is mostly empty: the same answer as in one that ends near it, at the cost of that.
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/resource.h>

#include "files.hpp"
#include "plan/plan.hpp"
#include "resumed_runs.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

using scenes::with;

struct GridRun {
  Summary summary;
  std::string history;
};

// The largest so far [bytes].
double resident_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

GridRun run_of(const std::string& text, const std::vector<std::string>& set) {
  const TemporaryFolder folder;
  GridRun ended{run(load_scene(folder.write("scene.toml", text), set), {.out = folder.path(), .threads = 1}), ""};
  ended.history = contents(folder.path() / "history.csv");
  return ended;
}

const std::string soft_rubber = "[material.m]\nlaw = \"neo-hookean\"\nE = 1e5\nnu = 0.3\nrho = 1000\n";

// A block of 2 × 1.5 that stands on the bottom, between 4 and 6, in cells of 1/4, whose multiples are exact. The grid
// ends at `ends`.
const std::string standing = R"toml(
dim = 2
[constants]
ends = 8
[grid]
min = [0, 0]
max = ["ends", "ends"]
cells = [32, 32]
[[body]]
min = [4, 0]
max = [6, 1.5]
material = "m"
placement = "gauss"
[[support]]
face = "bottom"
[body_force]
value = [0.5, -10]
[[probe]]
name = "top"
at = [4.6, 1.4]
fields = ["u.y", "stress.yy"]
[stop]
steps = 100000
)toml" + soft_rubber;

// A block that stands on the bottom, and another one that flies past it, further than numbers reach at first.
const std::string flying = R"toml(
dim = 2
[constants]
ends = 128
[grid]
min = [0, 0]
max = ["ends", "ends"]
cells = [512, 512]
[[body]]
min = [4, 0]
max = [6, 1.5]
material = "m"
placement = "gauss"
[[body]]
min = [9, 0.125]
max = [10, 1]
material = "m"
placement = "gauss"
[[support]]
face = "bottom"
[initial]
v = ["2*min(1, max(0, (x-7)*1000))", "0"]
[body_force]
value = ["0", "-20*min(1, max(0, (7-x)*1000))"]
[phase]
quadrature = "points"
max_motion = 0.2
[damping]
strategy = "none"
[output]
every = 0.2
[stop]
time = 3
residual = 0
)toml" + soft_rubber;

const std::vector<std::string> in_large{"constants.ends=128", "grid.cells=[512, 512]"};

void same_in_both(const std::string& text, const std::vector<std::string>& settings,
                  const std::vector<std::string>& small, const std::vector<std::string>& large) {
  const GridRun small_grid = run_of(text, with(settings, small)), large_grid = run_of(text, with(settings, large));
  CHECK(small_grid.summary.status == large_grid.summary.status);
  CHECK(small_grid.summary.dofs == large_grid.summary.dofs);
  CHECK(small_grid.history.size() > 100);
  CHECK(small_grid.history == large_grid.history);
}

}  // namespace

TEST_CASE("a body takes the same bits to rest in a grid that is 256 times as large, with every basis and solver") {
  const std::string basis = GENERATE("linear", "quadratic", "cubic", "hermite");
  const std::string way =
      GENERATE("damping.strategy=auto", "damping={strategy=\"viscous\", c=50}", "solve.method=newton");
  INFO(basis << ", " << way);
  same_in_both(standing, {"grid.basis=" + basis, way, "mass.kind=lumped", "body[0].points_per_cell=4"}, {}, in_large);
}

TEST_CASE("a body that slides along the bottom for many cells has the same bits in a grid that is far larger") {
  const std::string basis = GENERATE("linear", "quadratic");
  const std::string quadrature = GENERATE("points", "domains");
  INFO(basis << ", " << quadrature);
  // It slides over 16 cells, so that others get numbers on its way; on a wall, and then on what holds the bottom.
  const std::vector<std::string> settings{"grid.basis=" + basis,
                                          "phase.quadrature=" + quadrature,
                                          "body[0].placement=uniform",
                                          "phase.max_motion=0.2",
                                          "support=[]",
                                          "wall=[{name=\"floor\", face=\"bottom\"}, {name=\"side\", face=\"left\"}]",
                                          "stop.time=2",
                                          "stop.residual=0",
                                          "body_force.value=[2, -10]",
                                          "damping.strategy=none",
                                          "output.every=0.1"};
  same_in_both(standing, settings, {"grid.cells=[44, 8]", "grid.max=[11, 2]"}, in_large);
}

TEST_CASE("a body that falls from far away lands on what holds the bottom as it does in a small grid") {
  const std::vector<std::string> settings{
      "body[0].min=[4, 8]",    "body[0].max=[6, 9.5]",      "phase.max_motion=0.2", "stop.time=2.5", "stop.residual=0",
      "damping.strategy=none", "body_force.value=[0, -10]", "output.every=0.1",     "probe=[]"};
  // All cells of the first one have numbers.
  same_in_both(standing, settings, {"grid.cells=[20, 40]", "grid.min=[2, 0]", "grid.max=[7, 10]"}, in_large);
}

TEST_CASE("what holds a body on the bottom does not take hold of another one that flies past, as numbers change") {
  const std::string basis = GENERATE("linear", "quadratic", "cubic");
  INFO(basis);
  // With splines the deformation comes from the positions, and is 0 where the ground has held from the beginning.
  same_in_both(flying, {"grid.basis=" + basis}, {"grid.max=[18, 3]", "grid.cells=[72, 12]"}, {});
}

TEST_CASE("a ball in space takes the same bits to rest on a plane in a grid that is 64 times as large") {
  const std::string ball = R"toml(
dim = 3
[constants]
ends = 4
[grid]
min = [0, 0, 0]
max = ["ends", "ends", "ends"]
cells = [8, 8, 8]
[[body]]
sphere = [2, 2, 1]
radius = 0.9
material = "m"
[[rigid]]
name = "floor"
half_plane = [[0, 0, 0.2], [0, 0, 1]]
friction = "rough"
[body_force]
value = [0, 0, -10]
[damping]
strategy = "auto"
[output]
every = 0.01
[stop]
steps = 400
)toml" + soft_rubber;
  same_in_both(ball, {}, {}, {"constants.ends=32", "grid.cells=[64, 64, 64]"});
}

TEST_CASE("a body in a grid of nine million cells is said to need, and takes, the memory of one that ends near it") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("scene.toml", standing);
  const auto bytes = [&](const std::vector<std::string>& set) { return make_plan(load_scene(file, set)).bytes(); };
  const std::vector<std::string> in_vast{"constants.ends=750", "grid.cells=[3000, 3000]"};
  CHECK(bytes(in_vast) < 1.05 * bytes({}));
  const auto before = resident_memory();
  CHECK(run(load_scene(file, in_vast), {.threads = 1}).status == RunStatus::equilibrium);
  CHECK(resident_memory() - before < 50e6);  // a vector over all functions would be 144 MB
}

TEST_CASE("splines in a large grid whose numbers have changed go on with the same bits after a run is broken off") {
  const TemporaryFolder folder;
  const Scene scene =
      load_scene(folder.write("scene.toml", flying), {"grid.basis=quadratic", "checkpoint.every_steps=40"});
  {
    Simulation simulation(scene, {.out = folder.path() / "out"});
    while (!simulation.done() && simulation.steps() < 130) simulation.step();
    REQUIRE(simulation.phases() > 5);
  }
  CHECK((resumed(folder.path() / "out") == unbroken(scene)));
}

TEST_CASE("a run in a large empty grid that is broken off amid its way and resumed has the bits of the unbroken one") {
  const std::vector<std::string> settings =
      with(in_large, {"phase.max_motion=0.2", "support=[]", "stop.time=2", "stop.residual=0",
                      "wall=[{name=\"floor\", face=\"bottom\"}]", "body_force.value=[2, -10]", "damping.strategy=none",
                      "output.every=0.1"});
  const TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("scene.toml", standing), with(settings, {"checkpoint.every_steps=100"}));
  {
    Simulation simulation(scene, {.out = folder.path() / "out"});
    while (!simulation.done() && simulation.steps() < 750) simulation.step();
    REQUIRE(simulation.phases() > 5);
  }
  CHECK((resumed(folder.path() / "out") == unbroken(scene)));
}

}  // namespace stillpoint::test

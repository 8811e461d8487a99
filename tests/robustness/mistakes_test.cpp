// What a new user gets wrong: each mistake is told with its place, what is wrong, and what was expected or is meant.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "broken_scene.hpp"
#include "command_run.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using stillpoint::test::CommandRun;
using stillpoint::test::kGoodScene;

namespace {

struct Slip {
  std::string override, place, cause, remedy;
};

// Of problems/block.toml.
const std::vector<Slip> slips{
    {"gravity=9.81", "--set gravity", "unknown key 'gravity'", "did you mean 'body_force'?"},
    {"bc.face=left", "--set bc", "unknown key 'bc'", "did you mean 'support'?"},
    {"solver.method=newton", "--set solver", "unknown key 'solver'", "did you mean 'solve'?"},
    {"mesh.cells=4", "--set mesh", "unknown key 'mesh'", "did you mean 'grid'?"},
    {"quux.cells=4", "--set quux", "unknown key 'quux'", "contact, force, traction, body_force, load"},
    {"grid.cells=[16]", "grid.cells", "found 1", "expected 2 values"},
    {"grid.cells=[0, 4]", "grid.cells[0]", "not 0", "must be a whole number from 1"},
    {"grid.cells=[16.5, 4]", "grid.cells[0]", "not 16.5", "must be a whole number"},
    {"grid.max=[-2, 1]", "grid.max[0]", "not -2", "must be greater than grid.min[0] = 0"},
    {"grid.basis=linar", "grid.basis", "unknown value 'linar'", "did you mean 'linear'?"},
    {"grid.basis=C0", "grid.basis", "unknown value 'C0'", "expected one of linear, quadratic, cubic, hermite"},
    {"body.material=ruber", "body.material", "there is no material 'ruber'", "did you mean 'rubber'?"},
    {"body.state=strain", "body.state", "unknown value 'strain'", "did you mean 'plane-strain'?"},
    {"body.points_per_cell=5", "body.points_per_cell", "not 5", "must be a square"},
    {"body.min=[5, 5]", "body.min[0]", "5 lies outside the grid", "0 to 1"},
    {"body.polygon=[[0, 0], [1, 1], [1, 0], [0, 1]]", "body.polygon", "its sides cross or touch at (0.5, 0.5)",
     "corners in their order"},
    {"material.rubber.nu=0.5", "material.rubber.nu", "not 0.5", "less than 0.5"},
    {"material.rubber.E=-1", "material.rubber.E", "not -1", "greater than 0"},
    {"material.rubber.law=elastic", "material.rubber.law", "unknown value 'elastic'", "did you mean 'linear-elastic'?"},
    {"material.rubber.law=tresca", "material.rubber.law", "unknown value 'tresca'", "did you mean 'mohr-coulomb'?"},
    {"material.rubber.density=1", "material.rubber", "unknown key 'density'", "did you mean 'rho'?"},
    {"support=[{face='south'}]", "support[0].face", "unknown value 'south'", "did you mean 'bottom'?"},
    {"support=[{face='bottom', kind='pinned'}]", "support[0].kind", "unknown value 'pinned'", "did you mean 'fixed'?"},
    {"support=[{face='bottom'}, {face='bottom'}]", "support[1].face", "stands on this face already", "support[0]"},
    {"traction=[{face='top', value=-0.1}]", "traction[0].value", "found 1", "expected 2 values"},
    {"traction=[{face='top', value=[0, '-0.1*tt']}]", "traction[0].value[1]", "unknown name 'tt'", "did you mean 't'?"},
    {"traction=[{face='top', value=[0, '-0.1*(t']}]", "traction[0].value[1]", "a ')' is missing", "at character 8"},
    {"damping.strategy=critical", "damping.strategy", "unknown value 'critical'", "did you mean 'viscous'?"},
    {"damping.c=-1", "damping.c", "not -1", "at least 0"},
    {"stop.tolerance=1e-6", "--set stop.tolerance", "unknown key 'tolerance'", "did you mean 'residual'?"},
    {"stop.time=-5", "stop.time", "not -5", "at least 0"},
    {"solve.method=newtons", "solve.method", "unknown value 'newtons'", "did you mean 'newton'?"},
    {"mass.kind=diagonal", "mass.kind", "unknown value 'diagonal'", "did you mean 'lumped'?"},
    {"integrator.method=rk4", "integrator.method", "unknown value 'rk4'", "did you mean 'erk:rk4'?"},
    {"integrator.method=euler", "integrator.method", "unknown value 'euler'", "did you mean 'symplectic-euler'?"},
    {"probe=[{name='a', at=[50, 50], fields=['u.x']}]", "probe[0].at[0]", "50 lies outside the body", "0 to 1"},
    {"probe=[{name='a', at=[1, 1], fields=['stress_yy']}]", "probe[0].fields[0]", "unknown field 'stress_yy'",
     "did you mean 'stress.yy'?"},
    {"probe=[{name='a', at=[1, 1], fields=['sigma_yy']}]", "probe[0].fields[0]", "unknown field 'sigma_yy'",
     "did you mean 'stress.yy'?"},
    {"probe=[{name='a', at=[1, 1], fields=['sxx']}]", "probe[0].fields[0]", "unknown field 'sxx'",
     "did you mean 'stress.xx'?"},
    {"probe=[{name='a', at=[1, 1], fields=['displacement.x']}]", "probe[0].fields[0]", "unknown field 'displacement.x'",
     "did you mean 'u.x'?"},
    {"phase.motion=0.1", "--set phase.motion", "unknown key 'motion'", "expected one of max_motion"},
    {"body_force.value=9.81", "body_force.value", "found 1", "expected 2 values"},
    {"output.every=-1", "output.every", "not -1", "at least 0"},
    {"initial.geostatic={K0=0.5, surface=1}", "initial.geostatic", "needs a [body_force]",
     "the weight that the stress bears"},
    {"dim=4", "dim", "not 4", "from 1 to 3"},
};

// What a run of a few steps says of a scene: why it is refused, or its notes.
std::string told(const std::string& name, std::vector<std::string> overrides) {
  overrides.emplace_back("stop.steps=3");
  try {
    return fmt::format("{}", fmt::join(run(scenes::load(name, overrides)).notes, "\n"));
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("each mistake is told with its place, its cause and the remedy") {
  for (const Slip& slip : slips) {
    CAPTURE(slip.override);
    const std::string message = scenes::refusal("block", {slip.override});
    CHECK_THAT(message, Catch::Contains(slip.place));
    CHECK_THAT(message, Catch::Contains(slip.cause));
    CHECK_THAT(message, Catch::Contains(slip.remedy));
  }
}

TEST_CASE("the command names the subcommand that is meant") {
  const CommandRun run(kGoodScene, "rnu SCENE --out OUT");
  CHECK(run.status == 2);
  CHECK(run.standard_error == "unknown command 'rnu'; did you mean 'run'?\n");
}

TEST_CASE("a folder without a checkpoint is named once, with what it lacks") {
  const CommandRun none(kGoodScene, "run --resume OUT");
  CHECK(none.status == 2);
  CHECK_THAT(none.standard_error, Catch::Contains("there is no such folder"));
  const CommandRun empty(kGoodScene, "run --resume /");
  CHECK(empty.status == 2);
  CHECK_THAT(empty.standard_error, Catch::StartsWith("--resume /: there is no checkpoint.h5 in it to go on from"));
  const CommandRun both(kGoodScene, "run SCENE --resume OUT");
  CHECK(both.status == 2);
  CHECK_THAT(both.standard_error, Catch::Contains("leave out"));
}

TEST_CASE("a body that nothing holds is told of under a ramp as under a steady load") {
  const std::string steady = told("block", {"support=[{face='left', kind='roller'}]", "body_force.value=[0, -0.1]"});
  CHECK_THAT(steady, Catch::Contains("nothing holds the body along y"));
  const std::string ramp =
      told("block", {"support=[{face='left', kind='roller'}]", "body_force.value=[0, '-0.1*min(t/3, 1)']"});
  CHECK_THAT(ramp, Catch::Contains("nothing holds the body along y") && Catch::Contains("expected a support"));
  // Loads that swing or grow for ever have no end to be judged by.
  CHECK_THAT(
      told("block", {"support=[{face='left', kind='roller'}]", "body_force.value=[0, '-0.1*exp(t)']", "damping.c=1"}),
      !Catch::Contains("nothing holds the body along y, where"));
  CHECK_THAT(
      told("block", {"support=[{face='left', kind='roller'}]", "body_force.value=[0, '-0.1*sin(t)']", "damping.c=1"}),
      !Catch::Contains("nothing holds the body along y, where"));
}

TEST_CASE("numbers in likely other units, or of another sign or time, are noted and not refused") {
  CHECK_THAT(told("stable_slope", {"material.soil.phi=0.35"}),
             Catch::Contains("phi = 0.35 is taken as degrees") && Catch::Contains("20.05 degrees"));
  const std::string steel = "material.rubber={law='linear-elastic', E=210e9, nu=0.3, rho=7.85}";
  CHECK_THAT(told("block", {steel}), Catch::Contains("rho = 7.85 is the density of no solid"));
  CHECK_THAT(told("block", {"body_force.value=[0, 9.81]"}), Catch::Contains("body_force points up"));
  CHECK_THAT(told("block", {"output.stages=[1, 50]", "stop.time=20"}), Catch::Contains("output.stages has 50"));
}

TEST_CASE("nothing is noted of units in scenes that have none, or whose numbers are as usual") {
  for (const std::string name : {"block", "stable_slope", "column", "footing", "cantilever"}) {
    const std::string notes = told(name, {});
    CAPTURE(name, notes);
    for (const char* const word : {"density of no solid", "taken as degrees", "points up", "output.stages"})
      CHECK(notes.find(word) == std::string::npos);
  }
}

// What is wrong with a scene is said in words, at its line and column, all at once.
#include <stillpoint/scene.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "broken_scene.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

constexpr const char* kMotion =
    "[damping]\nstrategy = \"viscous\"\nc = 0.3\n[integrator]\nmethod = \"leapfrog\"\nstep_fraction = 0.9\n";
constexpr const char* kLoadAndMotion =
    "\"P0\"\n[damping]\nstrategy = \"viscous\"\nc = 0.3\n[integrator]\nmethod = \"leapfrog\"\nstep_fraction = 0.9\n";

const std::vector<BadScene> kBadScenes = {
    {"not TOML", "cells = 4", "cells = ", "6:9", "not valid TOML"},
    {"a key twice", "E = 1.0", "E = 1.0\nE = 2.0", "13:5", "not valid TOML"},
    {"key at the top", "[constants]", "titel = \"bar\"\n[constants]", "1:1",
     "unknown key 'titel'; did you mean 'title'?"},
    {"key in a table", "[body]", "[body]\nplacment = 1", "8:1",
     "body: unknown key 'placment'; did you mean 'placement'?"},
    {"key far from any", "c = 0.3", "mushroom = 0.3", "22:1", "expected one of strategy, c, alpha"},
    {"key in an entry", "u = 0.0", "uu = 0.0", "16:1", "support[0]: unknown key 'uu'; did you mean 'u'?"},
    {"unknown table", "[damping]", "[dampling]", "20:2", "unknown key 'dampling'; did you mean 'damping'?"},
    {"material's key", "rho = 1.0", "rho = 1.0\nroh = 1.0", "14:1", "unknown key 'roh'; did you mean 'rho'?"},
    {"a missing key", "cells = 4\n", "", "3:1", "grid: the key 'cells' is missing"},
    {"a missing parameter", "rho = 1.0\n", "", "10:1", "material.steel: the key 'rho' is missing"},
    {"a missing law", "law = \"linear-elastic\"\n", "", "10:1", "material.steel: the key 'law' is missing"},
    {"string for number", "E = 1.0", "E = \"stiff\"", "12:6", "material.steel.E: unknown name 'stiff'"},
    {"bool for number", "max = 10.0", "max = true", "5:7", "grid.max: expected a number or a formula, found true"},
    {"number for string", "\"steel\"", "3", "8:12", "body.material: expected a string, found the number 3"},
    {"value for table", "[damping]", "[[damping]]", "20:1", "damping: expected a table, found an array of tables"},
    {"table for array", "[[force]]", "[force]", "17:1", "force: expected an array of tables, [[force]]"},
    {"wrong length", "max = 10.0", "max = [10.0, 3.0]", "5:7", "grid.max: expected 1 value, found 2"},
    {"no law like it", "\"linear-elastic\"", "\"linear-elastik\"", "11:7", "did you mean 'linear-elastic'?"},
    {"no material like it", "\"steel\"", "\"stel\"", "8:12", "there is no material 'stel'; did you mean 'steel'?"},
    {"no density", "rho = 1.0", "rho = 0", "13:7", "material.steel.rho: must be greater than 0, not 0"},
    {"negative stiffness", "E = 1.0", "E = -2", "12:5", "material.steel.E: must be greater than 0, not -2"},
    {"Poisson's ratio", "E = 1.0", "E = 1.0\nnu = 0.5", "13:6", "must be greater than -1 and less than 0.5, not 0.5"},
    {"zero cells", "cells = 4", "cells = 0", "6:9", "grid.cells: must be a whole number from 1 to 10000000, not 0"},
    {"half a cell", "cells = 4", "cells = 4.5", "6:9", "not 4.5"},
    {"too many cells", "cells = 4", "cells = 9223372036854775807", "6:9", "not 9223372036854775807"},
    {"far too many cells", "cells = 4", "cells = 1e300", "6:9", "not 1e+300"},
    {"too many points", "cells = 4\n[body]\nmaterial = \"steel\"\npoints_per_cell = 3",
     "cells = 10000000\n[body]\nmaterial = \"steel\"\npoints_per_cell = 1000", "9:19", "1e+10 material points"},
    {"pieces and more", "min = 0.0\nmax = 10.0\ncells = 4", "max = 10.0\nx = [[0, 10, 4]]", "4:7",
     "grid.max: follows from the pieces of grid.x"},
    {"no piece", "min = 0.0\nmax = 10.0\ncells = 4", "x = 4", "4:5",
     "grid.x: expected an array of rows, found the number 4"},
    {"a row alone", "min = 0.0\nmax = 10.0\ncells = 4", "x = [0, 10, 4]", "4:6",
     "grid.x[0]: expected [from, to, cells] or [from, to, cells, ratio], found the number 0"},
    {"a short row", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 3, 2], [3, 10]]", "4:17",
     "grid.x[1]: expected [from, to, cells] or [from, to, cells, ratio], found 2 values"},
    {"half a cell of a piece", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 10, 2.5]]", "4:14",
     "grid.x[0][2]: must be a whole number from 1 to 10000000, not 2.5"},
    {"a ratio of 0", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 10, 4, 0]]", "4:17",
     "grid.x[0][3]: must be greater than 0, not 0"},
    {"the ratio of one cell", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 10, 1, 2]]", "4:17",
     "grid.x[0][3]: is the length of a piece's last cell over that of its first"},
    {"a piece upside down", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 3, 4],\n [3, 3, 4]]", "5:6",
     "grid.x[1][1]: must be greater than 3, where the piece begins, not 3"},
    {"a gap between pieces", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 3, 4], [3.5, 10, 4]]", "4:18",
     "grid.x[1][0]: a piece begins where the one before it ends, at 3, not at 3.5"},
    {"a piece below rounding", "min = 0.0\nmax = 10.0\ncells = 4", "x = [[0, 10, 4, 1e13]]", "4:5",
     "grid.x: the smallest cell, of "},
    {"too many cells in pieces", "min = 0.0\nmax = 10.0\ncells = 4",
     "x = [[0, 1, 1e7], [1, 2, 1e7], [2, 3, 1e7], [3, 4, 1e7], [4, 5, 1e7], [5, 6, 1e7], [6, 7, 1e7], [7, 8, 1e7], "
     "[8, 9, 1e7], [9, 9.5, 1e7], [9.5, 10, 1e7]]",
     "4:5", "grid.x: 1.1e+08 cells are more than this program takes (1e+08)"},
    {"an axis that is not there", "cells = 4", "cells = 4\ny = [[0, 1, 2]]", "7:1", "grid: unknown key 'y'"},
    {"an empty grid", "max = 10.0", "max = 0", "5:7", "grid.max: must be greater than grid.min = 0, not 0"},
    {"cells below rounding", "min = 0.0\nmax = 10.0", "min = 1e16\nmax = 10000000000000004", "6:9", "too small"},
    {"body before grid", "[body]", "[body]\nmin = -1", "8:7", "body.min: -1 lies outside the grid, 0 to 10"},
    {"body past grid", "[body]", "[body]\nmax = 11", "8:7", "body.max: 11 lies outside the grid, 0 to 10"},
    {"body inside out", "[body]", "[body]\nmin = 5\nmax = 5", "9:7", "must be greater than body.min = 5, not 5"},
    {"no area", "[body]", "[body]\narea = 0", "8:8", "body.area: must be greater than 0, not 0"},
    {"negative seed", "[body]", "[body]\nseed = -1", "8:8", "must be a whole number of at least 0, not -1"},
    {"support outside", "at = 0.0", "at = -0.5", "15:6", "support[0].at: -0.5 lies outside the grid, 0 to 10"},
    {"support twice", "[[force]]", "[[support]]\nat = 0\n[[force]]", "18:6", "support[0] holds this position already"},
    {"support's component", "u = 0.0", "component = 1", "16:13", "must be a whole number from 0 to 0, not 1"},
    {"force outside", "at = 10.0", "at = 12", "18:6", "force[0].at: 12 lies outside the body, 0 to 10"},
    {"not a number", "at = 10.0", "at = nan", "18:6", "force[0].at: expected a finite number, found nan"},
    {"infinite", "c = 0.3", "c = inf", "22:5", "damping.c: expected a finite number, found inf"},
    {"infinite formula", "value = \"P0\"", "value = \"P0/0\"", "19:9", "the value inf is not a finite number"},
    {"unknown name", "value = \"P0\"", "value = \"2*P1\"", "19:12", "unknown name 'P1'; did you mean 'P0'?"},
    {"x in a load", "value = \"P0\"", "value = \"P0*x\"", "19:13", "'x' cannot be used here: this is a formula of t"},
    {"half a formula", "value = \"P0\"", "value = \"P0*(1+t\"", "19:17", "a ')' is missing"},
    {"escaped formula", "value = \"P0\"", "value = \"\\tP0*t2\"", "19:9",
     "unknown name 't2'; did you mean 't'? (at character 5 of"},
    {"no damping like it", "\"viscous\"", "\"viscose\"", "21:12", "did you mean 'viscous'?"},
    {"negative damping", "c = 0.3", "c = -0.1", "22:5", "damping.c: must be at least 0, not -0.1"},
    {"critical misspelt", "c = 0.3", "c = \"critcal\"", "22:5", "did you mean 'critical'?"},
    {"alpha of 1", "c = 0.3", "alpha = 1.0", "22:9", "damping.alpha: must be at least 0 and less than 1, not 1"},
    {"no method like it", "\"leapfrog\"", "\"leepfrog\"", "24:10", "did you mean 'leapfrog'?"},
    {"a key of another strategy", "c = 0.3", "peak = \"parabolic\"", "22:8",
     "damping.peak: goes with strategy = \"kinetic\", not with 'viscous'"},
    {"a quotient of no strategy", "c = 0.3", "quotient = \"global\"", "22:12", "goes with strategy = \"adaptive\""},
    {"no peak like it", "\"viscous\"\nc = 0.3", "\"kinetic\"\npeak = \"half\"", "22:8",
     "expected one of half-step, parabolic"},
    {"c of a strategy that finds its own", "\"viscous\"", "\"adaptive\"", "22:5",
     "damping.c: goes with strategy = \"viscous\" or \"identity\", not with 'adaptive'"},
    {"alpha of a strategy without", "\"viscous\"\nc = 0.3", "\"fire\"\nalpha = 0.3", "22:9",
     "goes with strategy = \"one-sided\", \"cundall\" or \"combined\", not with 'fire'"},
    {"an iteration and another method", "\"viscous\"\nc = 0.3\n[integrator]\nmethod = \"leapfrog\"",
     "\"fire\"\n[integrator]\nmethod = \"erk:rk4\"", "23:10",
     "damping 'fire' does not go with method 'erk:rk4'; it goes with leapfrog"},
    {"combined and many stages", "\"viscous\"\nc = 0.3\n[integrator]\nmethod = \"leapfrog\"",
     "\"combined\"\n[integrator]\nmethod = \"gsl:rk4\"", "23:10", "it goes with leapfrog, symplectic-euler"},
    {"a treatment of no C v", "\"viscous\"\nc = 0.3\n[integrator]\nmethod = \"leapfrog\"\nstep_fraction = 0.9",
     "\"auto\"\n[integrator]\ndamping = \"lagged\"", "23:11", "damping 'auto' is no C v to be treated"},
    {"Chebyshev's step", "\"viscous\"\nc = 0.3", "\"chebyshev\"", "24:17",
     "damping 'chebyshev' has its own step; leave this out"},
    {"a static solver as a damping", "\"viscous\"\nc = 0.3", "\"cg\"", "21:12",
     "damping.strategy: 'cg' is a static solver, not a damping or a relaxation; write solve.method = \"cg\""},
    {"a damping as a solver", "[damping]", "[solve]\nmethod = \"viscous\"\n[damping]", "21:10",
     "solve.method: 'viscous' is a way to rest in time, not a static solver; write damping.strategy = \"viscous\""},
    {"no solver like it", "[damping]", "[solve]\nmethod = \"newtn\"\n[damping]", "21:10",
     "solve.method: unknown value 'newtn'; did you mean 'newton'?"},
    {"a velocity without time", kMotion, "[initial]\nv = 1.0\n[solve]\nmethod = \"cg\"\n", "21:5",
     "initial.v: 'cg' is a static solver, which has no velocity"},
    {"a load in time without time", kLoadAndMotion, "\"P0*t\"\n[solve]\nmethod = \"lbfgs\"\n", "21:10",
     "solve.method: 'lbfgs' is a static solver, which has no time: loads and supports must not depend on t"},
    {"a load in time and no end of it", kLoadAndMotion, "\"P0*t\"\n[solve]\nmethod = \"newton\"\n", "21:10",
     "loads and supports depend on t, so give stop.time, at which it takes them"},
    {"a wall without time", kMotion,
     "[mass]\nkind = \"lumped\"\n[[wall]]\nname = \"w\"\nface = \"right\"\n[solve]\nmethod = \"newton\"\n", "26:10",
     "solve.method: 'newton' is a static solver, in which no wall can open or close; take \"relaxation\""},
    {"phases without time", kMotion, "[solve]\nmethod = \"newton\"\n[phase]\nmax_motion = 0.1\n", "23:14",
     "phase.max_motion: 'newton' is a static solver, which needs a single phase: take \"none\""},
    {"strain of phases without time", kMotion, "[solve]\nmethod = \"newton\"\n[phase]\nmax_strain = 0.1\n", "23:14",
     "phase.max_strain: 'newton' is a static solver, which needs a single phase: leave this out"},
    {"a damping without time",
     "strategy = \"viscous\"\nc = 0.3\n[integrator]\nmethod = \"leapfrog\"\nstep_fraction = 0.9",
     "alpha = 0.5\n[solve]\nmethod = \"newton\"", "21:9", "damping.alpha: has no part in a static solution"},
    {"a distance below zero", "residual = 1e-6", "residual = 1e-6\ndistance = -1", "28:12",
     "stop.distance: must be at least 0, not -1"},
    {"no step", "step_fraction = 0.9", "step = 0", "25:8", "integrator.step: must be greater than 0, not 0"},
    {"two steps", "step_fraction = 0.9", "step = 1\nstep_fraction = 0.9", "26:17", "either step or step_fraction"},
    {"unstable step", "step_fraction = 0.9", "step_fraction = 1.1", "25:17", "1.1 of the critical step is unstable"},
    {"no error estimate", "step_fraction = 0.9", "rtol = 1e-3", "25:8", "'leapfrog' has no error estimate"},
    {"tolerance of 1", "\"leapfrog\"", "\"leapfrog\"\nrtol = 1", "25:8",
     "must be greater than 0 and less than 1, not 1"},
    {"treatment", "\"leapfrog\"", "\"leapfrog\"\ndamping = \"exact\"", "25:11", "does not go with method 'leapfrog'"},
    {"negative test", "residual = 1e-6", "residual = -1", "27:12", "stop.residual: must be at least 0, not -1"},
    {"endless", "residual = 1e-6", "residual = 0", "27:12", "nothing would ever stop this run"},
    {"no such point", "point = 12", "point = 13", "31:9", "there are 12 material points, so 13 is too large"},
    {"point 0", "point = 12", "point = 0", "31:9", "probe[0].point: must be a whole number from 1"},
    {"probe outside", "point = 12", "at = -1", "31:6", "probe[0].at: -1 lies outside the body, 0 to 10"},
    {"probe nowhere", "point = 12\n", "", "29:1", "probe[0]: give point, the number of a material point, or at"},
    {"probe at two places", "point = 12", "point = 12\nat = 1", "32:6", "give either point or at, not both"},
    {"point in space", "point = 12", "point = 12\nframe = \"space\"", "32:9",
     "goes with at only: a material point moves"},
    {"place in space", "point = 12", "at = 1\nframe = \"space\"", "32:9",
     "in a single phase everything is said of where"},
    {"mean without box", "point = 12", "kind = \"mean\"\nmin = 1", "29:1", "the key 'max' is missing"},
    {"mean of nothing", "point = 12", "kind = \"mean\"\nmin = 2\nmax = 1", "33:7", "must be at least min, 2, not 1"},
    {"mean at a place", "point = 12", "point = 1\nkind = \"mean\"\nmin = 1\nmax = 2", "31:9", "goes with a point only"},
    {"stress of a body", "point = 12", "kind = \"body\"", "32:11",
     "unknown field 'u'; expected one of volume, momentum"},
    {"probe with a comma", "\"tip\"", "\"a,b\"", "30:8", "cannot hold a comma, a quote or a control character"},
    {"probe without name", "\"tip\"", "\"\"", "30:8", "probe[0].name: must not be empty"},
    {"no fields", "[\"u\"]", "[]", "32:10", "probe[0].fields: name at least one of u, v, strain, stress"},
    {"unknown field", "[\"u\"]", "[\"u\", \"strss\"]", "32:16", "unknown field 'strss'; did you mean 'stress'?"},
    {"two probes, one name", "[\"u\"]", "[\"u\"]\n[[probe]]\nname = \"tip\"\nat = 1\nfields = [\"v\"]", "34:8",
     "there is a probe 'tip' already"},
    {"constants in a circle", "P0 = 1.0", "P0 = \"2*Q\"\nQ = \"P0\"", "2:6", "is defined by itself: P0 → Q → P0"},
    {"constant called x", "P0 = 1.0", "P0 = 1.0\nx = 2.0", "3:1", "x, y, z and t are the variables"},
    {"constant called sin", "P0 = 1.0", "P0 = 1.0\nsin = 2.0", "3:1", "a function has this name"},
    {"four dimensions", "[constants]", "dim = 4\n[constants]", "1:7", "dim: must be a whole number from 1 to 3, not 4"},
    {"dimension 0", "[constants]", "dim = 0\n[constants]", "1:7", "dim: must be a whole number from 1 to 3, not 0"},
    {"a plane's state", "[body]", "[body]\nstate = \"plane-strain\"", "8:9", "expected one of uniaxial-stress"},
    {"a plane's law", "\"linear-elastic\"", "\"drucker-prager\"\nphi = 30", "8:12",
     "law 'drucker-prager' has no state 'uniaxial-stress'; it has plane-strain, axisymmetric"},
    {"no body", "[body]\nmaterial = \"steel\"\npoints_per_cell = 3", "[[body]]\nmaterial = \"steel\"\n[[body]]", "9:1",
     "body[1]: the key 'material' is missing"},
    {"scaled consistent mass", "[damping]", "[mass]\nscaling = 4\n[damping]", "21:11",
     "mass.scaling: needs mass.kind = \"lumped\""},
    {"scaled by its bound", "[damping]", "[mass]\nscaling = \"gershgorin\"\n[damping]", "21:11",
     "mass.scaling: needs mass.kind = \"lumped\""},
    {"a wall's friction", "[damping]",
     "[mass]\nkind = \"lumped\"\n[[wall]]\nname = \"w\"\nface = \"left\"\nfriction = "
     "0.1\n[damping]",
     "25:12", "wall[0].friction: there is none in one dimension"},
    {"a wall and a full mass", "[damping]", "[[wall]]\nname = \"w\"\nface = \"left\"\n[damping]", "20:1",
     "a wall stops node by node, which needs mass.kind = \"lumped\""},
    {"a slope on a line", "point = 12\nfields = [\"u\"]", "kind = \"slope_angle\"", "31:8",
     "a slope has no angle in one dimension"},
    {"phases of hooke", "[damping]", "[mass]\nkind = \"lumped\"\n[phase]\nmax_strain = 0.1\n[damping]", "23:14",
     "phase.max_strain: 'linear-elastic' is a law of small strain"},
    {"force that is a pair", "[damping]", "[body_force]\nvalue = [1, 2]\n[damping]", "21:9",
     "expected 1 value, found 2"},
    {"bad variant", "[[probe]]", "[[variant]]\nname = \"v\"\nset = [\"damping.c=-1\"]\n[[probe]]", "31:7",
     "variant 'v': damping.c: must be at least 0, not -1"},
};

std::string only_problem_of(const std::string& override_text) {
  const TemporaryFolder folder;
  const auto problems = problems_of(folder.write("bar.toml", kGoodScene), {override_text});
  REQUIRE(problems.size() == 1);
  return to_string(problems[0].where) + ": " + problems[0].message;
}

}  // namespace

TEST_CASE("the scene that the tests break is good") {
  const TemporaryFolder folder;
  REQUIRE_NOTHROW(load_scene(folder.write("good.toml", kGoodScene)));
}

TEST_CASE("each of over 70 broken scenes gives one problem, with what is wrong, its line and its column") {
  REQUIRE(kBadScenes.size() >= 70);
  check_each(kBadScenes, kGoodScene);
}

TEST_CASE("five mistakes are reported at once, in the order of the file") {
  std::string scene = broken("max = 10.0", "max = \"L\"");
  scene = broken("rho = 1.0", "rho = -1", scene);
  scene = broken("u = 0.0", "uu = 0.0", scene);
  scene = broken("c = 0.3", "c = -1", scene);
  scene = broken("[\"u\"]", "[\"w\"]", scene);
  const TemporaryFolder folder;
  const auto problems = problems_of(folder.write("bad.toml", scene));
  std::vector<int> lines;
  for (const Mistake& problem : problems) lines.push_back(problem.where.line);
  REQUIRE(lines == std::vector<int>{5, 13, 16, 22, 32});
}

TEST_CASE("a wrong constant is reported where it is written, not where it is used") {
  const TemporaryFolder folder;
  const auto problems = problems_of(folder.write("bad.toml", broken("P0 = 1.0", "P0 = \"Q\"\nR = \"2*P0\"")));
  REQUIRE(problems.size() == 1);
  REQUIRE(problems[0].where.line == 2);
}

TEST_CASE("a scene that is not there, a folder and a huge file are refused by name") {
  const TemporaryFolder folder;
  const auto check = [](const std::filesystem::path& file, const char* message) {
    const auto problems = problems_of(file);
    REQUIRE(problems.size() == 1);
    CHECK(to_string(problems[0].where) == file.string());
    CHECK_THAT(problems[0].message, Catch::Contains(message));
  };
  check(folder.path() / "none.toml", "there is no such file");
  check(folder.path(), "is a directory");
  check(folder.write("huge.toml", std::string(std::size_t{17} << 20, '#')), "larger than 16 MiB");
  check("/dev/zero", "larger than 16 MiB");
}

TEST_CASE("an empty scene lacks its grid and its body") {
  const TemporaryFolder folder;
  const auto problems = problems_of(folder.write("empty.toml", ""));
  REQUIRE(problems.size() == 2);
  REQUIRE_THAT(problems[0].message, Catch::Contains("grid: this table is missing"));
  REQUIRE_THAT(problems[1].message, Catch::Contains("body: this table is missing"));
}

TEST_CASE("a wrong override is shown as it was typed") {
  CHECK(only_problem_of("damping.c") == "--set damping.c: expected key=value, for example --set damping.c=0.5");
  CHECK(only_problem_of("=3") == "--set =3: the key before '=' is missing");
  CHECK(only_problem_of("damping..c=3") == "--set damping..c=3: the key 'damping..c' has an empty part");
  CHECK(only_problem_of("probe[7].name=a") ==
        "--set probe[7].name=a: there is no 'probe'[7] in the scene, which has 1 of them");
  CHECK(only_problem_of("probe[x].name=a") ==
        "--set probe[x].name=a: 'probe[x].name' is not a key; expected, for example, probe[0].name");
  CHECK(only_problem_of("probe[0]=a") ==
        "--set probe[0]=a: 'probe[0]' is not a key; expected, for example, probe[0].name");
  CHECK(only_problem_of("probe.name=a") ==
        "--set probe.name=a: probe: is an array; --set can replace it, or reach into it with an index");
  CHECK(only_problem_of("damping.d=1") ==
        "--set damping.d=1: damping: unknown key 'd'; expected one of strategy, c, alpha, peak, quotient");
  CHECK(only_problem_of("damping.c=pi/") ==
        "--set damping.c=pi/: damping.c: the formula ends too early (at character 4 of 'pi/')");
  CHECK(only_problem_of("body=[]") == "--set body=[]: body: none is given: a scene has a body with a material");
  CHECK(only_problem_of("body=3") == "--set body=3: body: expected a table, found the number 3");
  CHECK(only_problem_of("initial.geostatic={K0=1, surface=2}") ==
        "--set initial.geostatic={K0=1, surface=2}: initial.geostatic: a level surface needs two dimensions");
  CHECK(only_problem_of("damping.c=") == "--set damping.c=: damping.c: the formula is empty");
}

// What is wrong with a plane scene is said in words, at its line and column, all at once.
#include <stillpoint/scene.hpp>

#include <vector>

#include <catch2/catch.hpp>

#include "broken_scene.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

const std::vector<BadScene> kBadGridsAndBodies = {
    {"plain number for a pair", "max = [8, 4]", "max = 8", "6:7", "grid.max: expected 2 values, found 1"},
    {"grid upside down", "max = [8, 4]", "max = [8, 0]", "6:11", "grid.max[1]: must be greater than grid.min[1] = 0"},
    {"cells below rounding", "min = [0, 0]\nmax = [8, 4]", "min = [0, 1e16]\nmax = [8, 10000000000000004]", "7:13",
     "grid.cells[1]: 4 cells between"},
    {"half a cell", "[8, 4]\nbasis", "[8, 4.5]\nbasis", "7:13", "grid.cells[1]: must be a whole number"},
    {"too many cells", "[8, 4]\nbasis", "[1000000, 1000]\nbasis", "7:9", "grid.cells: 1e+09 cells are more"},
    {"one axis by pieces", "min = [0, 0]\nmax = [8, 4]\ncells = [8, 4]", "x = [[0, 8, 8]]", "4:1",
     "grid: the key 'y' is missing: where one axis is given by pieces, all are"},
    {"a piece at a negative radius",
     "min = [0, 0]\nmax = [8, 4]\ncells = [8, 4]\nbasis = \"quadratic\"\nfollow = \"gate\"\n[body]",
     "x = [[-1, 8, 8]]\ny = [[0, 4, 4]]\nbasis = \"quadratic\"\nfollow = \"gate\"\n[body]\nstate = "
     "\"axisymmetric\"",
     "5:7", "grid.x[0][0]: is a radius in an axisymmetric scene, at least 0, not -1"},
    {"a wall that drives what is halted", "[mass]", "[damping]\nstrategy = \"kinetic\"\n[mass]", "23:12",
     "'kinetic' sets velocities to zero, also those that a moving wall gives"},
    {"no wall to follow", "follow = \"gate\"", "follow = \"gat\"", "9:10",
     "grid.follow: there is no wall 'gat'; did you mean 'gate'?"},
    {"past the grid", "max = [8, 3]", "max = [8, 5]", "11:11", "body.max[1]: 5 lies outside the grid, 0 to 4"},
    {"inside out", "max = [8, 3]", "min = [0, 3]\nmax = [8, 3]", "12:11",
     "must be greater than body.min[1] = 3, not 3"},
    {"not a square", "points_per_cell = 4", "points_per_cell = 5", "13:19", "must be a square (4 is 2 × 2 points"},
    {"three axes", "points_per_cell = 4", "points_per_cell = [2, 2, 2]", "13:19", "expected 2 values, found 3"},
    {"too many a cell", "points_per_cell = 4", "points_per_cell = 40000", "13:19", "from 1 to 10000, not 40000"},
    {"a line's state", "points_per_cell", "state = \"uniaxial-stress\"\npoints_per_cell", "13:9",
     "body.state: unknown value"},
    {"a line's area", "points_per_cell", "area = 2\npoints_per_cell", "13:1", "unknown key 'area'; expected one of"},
    {"no thickness", "points_per_cell", "thickness = 0\npoints_per_cell", "13:13", "must be greater than 0, not 0"},
    {"thick ring", "points_per_cell", "state = \"axisymmetric\"\nthickness = 1\npoints_per_cell", "14:13",
     "body.thickness: an axisymmetric body goes all the way round and has none"},
    {"negative radius", "min = [0, 0]\nmax = [8, 4]\ncells = [8, 4]\nbasis = \"quadratic\"\nfollow = \"gate\"\n[body]",
     "min = [-1, 0]\nmax = [8, 4]\ncells = [8, 4]\nbasis = \"quadratic\"\nfollow = \"gate\"\n[body]\nstate = "
     "\"axisymmetric\"",
     "5:8", "grid.min[0]: is a radius in an axisymmetric scene, at least 0, not -1"},
    {"jitter of 1", "points_per_cell", "jitter = 1\npoints_per_cell", "13:10", "at least 0 and less than 1, not 1"},
    {"jittered random", "points_per_cell", "jitter = 0.5\nplacement = \"random\"\npoints_per_cell", "13:10",
     "random points have no spacing"},
    {"two corners", "max = [8, 3]", "polygon = [[0, 0], [8, 0]]", "11:11", "needs from 3 to 1000 corners, not 2"},
    {"a corner of one", "max = [8, 3]", "polygon = [[0, 0], [8], [0, 3]]", "11:20",
     "body.polygon[1]: expected 2 coordinates, found 1"},
    {"no corners", "max = [8, 3]", "polygon = 3", "11:11", "expected an array of positions, found the number 3"},
    {"a corner outside", "max = [8, 3]", "polygon = [[0, 0], [9, 0], [0, 3]]", "11:21",
     "body.polygon[1][0]: 9 lies outside the grid, 0 to 8"},
    {"a bow", "max = [8, 3]", "polygon = [[0, 0], [8, 3], [8, 0], [0, 2]]", "11:11",
     "its sides cross or touch at (3.2, 1.2): that from corner 0 to 1 and that from 2 to 3"},
    {"closed twice", "max = [8, 3]", "polygon = [[0, 0], [8, 0], [0, 3], [0, 0]]", "11:11",
     "a polygon closes by itself"},
    {"flat", "max = [8, 3]", "polygon = [[0, 0], [8, 2], [4, 1]]", "11:11", "body.polygon: has no area"},
    {"box and polygon", "max = [8, 3]", "max = [8, 3]\npolygon = [[0, 0], [8, 0], [0, 3]]", "11:7",
     "body.max: does not go with polygon"},
    {"no file", "max = [8, 3]\nmaterial = \"sand\"\npoints_per_cell = 4", "material = \"sand\"\nfile = \"none.csv\"",
     "12:8", "none.csv' there is no such file"},
    {"no law like it", "\"drucker-prager\"", "\"drucker-praguer\"", "15:7", "did you mean 'drucker-prager'?"},
    {"no such cone", "cone = \"mean\"", "cone = \"men\"", "21:8",
     "material.sand.cone: unknown value 'men'; did you mean 'mean'?"},
    {"no density", "rho = 1600\n", "", "14:1", "material.sand: the key 'rho' is missing"},
    {"no angle to dilate below", "phi = \"angle\"\n", "", "19:7", "material.sand.psi: must be at most phi = 0, not 5"},
    {"too steep an angle", "phi = \"angle\"", "phi = 90", "19:7",
     "material.sand.phi: must be at least 0 and less than 90, not 90"},
    {"dilates too much", "psi = 5", "psi = 36", "20:7", "material.sand.psi: must be at most phi = 35, not 36"},
    {"no such state", "points_per_cell", "state = \"plane-stress\"\npoints_per_cell", "12:12",
     "law 'drucker-prager' has no state 'plane-stress'; it has plane-strain, axisymmetric"},
    {"two states", "[body]\nmax = [8, 3]\nmaterial = \"sand\"\n",
     "[[body]]\nmax = [4, 3]\nmaterial = \"sand\"\nstate = \"axisymmetric\"\n[[body]]\nmin = [4, 0]\nmax = [8, 3]\n"
     "material = \"sand\"\nstate = \"plane-strain\"\n",
     "18:9", "body[1].state: must be the same in all bodies"},
};

const std::vector<BadScene> kBadLoads = {
    {"support nowhere", "face = \"bottom\"", "", "28:1",
     "support[0]: give at, a position, or face, a side of the grid"},
    {"support twice", "face = \"bottom\"", "face = \"bottom\"\nat = [0, 0]", "29:8",
     "give either at or face, not both"},
    {"two on a face", "face = \"left\"", "face = \"bottom\"", "31:8", "support[0] stands on this face already"},
    {"a part outside the grid", "face = \"bottom\"", "face = \"bottom\"\nfrom = 2\nto = 9", "31:6",
     "support[0].to: 9 lies outside the grid, whose face reaches from 0 to 8"},
    {"a part that is empty", "face = \"bottom\"", "face = \"bottom\"\nfrom = 2\nto = 2", "31:6",
     "support[0].to: the part from 2 to 2 is empty; expected from < to"},
    {"a part that begins at the end", "face = \"bottom\"", "face = \"bottom\"\nfrom = 8", "30:8",
     "support[0].from: the part from 8 to 8 is empty"},
    {"a part of a position", "face = \"bottom\"", "at = [1, 0]\nfrom = 2", "30:8",
     "support[0].from: goes with a face, of which it holds a part"},
    {"parts that overlap", "[body_force]",
     "[[support]]\nface = \"top\"\nto = 4\n[[support]]\nface = \"top\"\nfrom = 3\n[body_force]", "42:8",
     "support[3].face: support[2] stands on this face already"},
    {"a wall on a part", "[body_force]", "[[support]]\nface = \"right\"\nto = 2\n[body_force]", "35:8",
     "support[2] stands on this face already"},
    {"a spring of no stiffness", "face = \"bottom\"", "face = \"bottom\"\nstiffness = 0", "30:13",
     "support[0].stiffness: must be greater than 0, not 0"},
    {"reactions of one name", "[[wall]]",
     "[[support]]\nface = \"top\"\nname = \"a\"\n[[support]]\nat = [8, 0]\nname = "
     "\"a\"\n[[wall]]",
     "38:8", "support[3].name: there is a support 'a' already"},
    {"wall on a support", "face = \"right\"", "face = \"left\"", "35:8", "support[1] stands on this face already"},
    {"no such face", "face = \"right\"", "face = \"rigth\"", "35:8",
     "wall[0].face: unknown value 'rigth'; did you mean"},
    {"a place's kind", "face = \"bottom\"", "at = [0, 0]\nkind = \"roller\"", "30:8", "goes with a face"},
    {"a component too high", "face = \"bottom\"", "at = [0, 0]\ncomponent = 2", "30:13",
     "support[0].component: must be a whole number from 0 to 1, not 2"},
    {"no such component", "face = \"bottom\"", "at = [0, 0]\ncomponent = \"z\"", "30:13",
     "support[0].component: r and z are the axes of an axisymmetric scene; expected x or y"},
    {"a component of none", "face = \"bottom\"", "at = [0, 0]\ncomponent = \"w\"", "30:13",
     "support[0].component: unknown value 'w'; expected one of x, y"},
    {"a component of a roller", "kind = \"roller\"", "kind = \"roller\"\ncomponent = 1", "32:8",
     "goes with a face as a whole; component says what is held"},
    {"a component twice", "face = \"left\"\nkind = \"roller\"", "face = \"bottom\"\ncomponent = \"y\"", "31:8",
     "support[0] stands on this face already"},
    {"no such kind", "\"roller\"", "\"rolls\"", "32:8",
     "support[1].kind: unknown value 'rolls'; expected one of fixed, roller"},
    {"a wall of x", "motion = \"0.05*t\"", "motion = \"0.05*x\"", "36:16", "'x' cannot be used here"},
    {"negative friction", "friction = \"rough\"", "friction = -1", "37:12",
     "wall[0].friction: must be at least 0, not -1"},
    {"rough misspelt", "friction = \"rough\"", "friction = \"rouhg\"", "37:12", "did you mean 'rough'?"},
    {"no wall's name", "name = \"gate\"\n", "name = \"\"\n", "34:8", "wall[0].name: must not be empty"},
    {"a probe's name", "name = \"toe\"", "name = \"gate\"", "34:8", "wall[0].name: there is a probe 'gate' already"},
    {"walls of one name", "[body_force]", "[[wall]]\nname = \"gate\"\nface = \"top\"\n[body_force]", "39:8",
     "wall[1].name: there is a wall 'gate' already"},
    {"walls on one face", "[body_force]", "[[wall]]\nname = \"lid\"\nface = \"right\"\n[body_force]", "40:8",
     "wall[1].face: wall[0] stands on this face already"},
    {"a wall that gets away", "follow = \"gate\"\n", "", "35:10",
     "a wall that moves has to stay on a grid line from phase to phase: give grid.follow = 'gate'"},
    {"two walls that move", "[body_force]", "[[wall]]\nname = \"lid\"\nface = \"top\"\nmotion = \"-t\"\n[body_force]",
     "41:10",
     "wall[1].motion: a wall that moves has to stay on a grid line from phase to phase, but the grid follows 'gate': "
     "let this one"},
    {"a traction of nothing", "[body_force]", "[[traction]]\nface = \"top\"\n[body_force]", "38:1",
     "traction[0]: give value, which keeps its direction, or pressure"},
    {"a traction of both", "[body_force]", "[[traction]]\nface = \"top\"\nvalue = [0, -1]\npressure = 1\n[body_force]",
     "41:12", "traction[0].pressure: give either value"},
    {"no weight", "[body_force]\nvalue = [0, -9.81]\n", "", "38:1", "initial.geostatic: needs a [body_force]"},
    {"a slanting weight", "value = [0, -9.81]", "value = [1, -9.81]", "39:9", "must be constant and vertical, [0, b]"},
    {"a growing weight", "value = [0, -9.81]", "value = [0, \"-9.81*t\"]", "39:9", "must be constant and vertical"},
    {"a weight of place", "value = [0, -9.81]", "value = [0, \"-9.81*y\"]", "39:9", "must be constant and vertical"},
    {"no rest", "K0 = 0.5", "K0 = 0", "41:6", "initial.geostatic.K0: must be greater than 0, not 0"},
    {"buried surface", "surface = 3", "surface = 2.5", "42:11",
     "initial.geostatic.surface: must not lie below the top of the body at 3, not 2.5"},
    {"geostatic of an elastic law",
     "law = \"drucker-prager\"\nE = 1e7\nnu = 0.3\nrho = 1600\nphi = \"angle\"\npsi = 5\ncone = \"mean\"",
     "law = \"neo-hookean\"\nE = 1e7\nnu = 0.3\nrho = 1600\n\n\n", "15:7",
     "initial.geostatic needs a law that keeps a stress"},
    {"two initial states", "[initial.geostatic]", "[initial]\nu = [0, 0]\n[initial.geostatic]", "41:5",
     "initial.u: does not go with initial.geostatic"},
    {"stress in the plane", "[output]", "[exact]\nstress = 1\n[output]", "44:10",
     "exact.stress: expected 4 values (xx, yy, zz, xy), found 1"},
    {"stress without u", "[output]", "[exact]\nstress = [0, 0, 0, 0]\n[output]", "44:10",
     "exact.stress: needs exact.u beside it"},
};

const std::vector<BadScene> kBadPhasesAndOutput = {
    {"no such mass", "scaling = 25", "kind = \"lumpd\"", "23:8",
     "mass.kind: unknown value 'lumpd'; did you mean 'lumped'?"},
    {"no mass", "scaling = 25", "scaling = 0", "23:11", "mass.scaling: must be greater than 0, not 0"},
    {"gershgorin misspelt", "scaling = 25", "scaling = \"gerschgorin\"", "23:11", "did you mean 'gershgorin'?"},
    {"a cell a phase", "max_motion = 0.1", "max_motion = 1", "25:14", "at least 0 and less than 1, not 1"},
    {"none misspelt", "max_motion = 0.1", "max_motion = \"non\"", "25:14", "did you mean 'none'?"},
    {"no strain", "max_motion = 0.1", "max_strain = 0", "25:14", "phase.max_strain: must be greater than 0, not 0"},
    {"no such transfer", "\"flip\"", "\"flop\"", "26:12", "phase.transfer: unknown value 'flop'; did you mean 'flip'?"},
    {"more than all", "0.99", "1.01", "27:14", "phase.flip_share: must be at least 0 and at most 1, not 1.01"},
    {"a share of pic", "\"flip\"", "\"pic\"", "27:14", "flip_share: goes with transfer = \"flip\" only"},
    {"an order of flip", "flip_share = 0.99", "xpic_order = 3", "27:14",
     "xpic_order: goes with transfer = \"xpic\" only"},
    {"order 0", "transfer = \"flip\"\nflip_share = 0.99", "transfer = \"xpic\"\nxpic_order = 0", "27:14",
     "from 1 to 20, not 0"},
    {"hermite", "\"quadratic\"", "\"hermite\"", "8:9", "grid.basis: 'hermite' has no lumped mass to carry velocities"},
    {"a pin that moves", "[output]", "[[support]]\nat = [8, 0]\nu = \"0.1*t\"\n[output]", "45:5",
     "support[2].u: the material that moves with this support leaves its node from phase to phase; let it rest"},
    {"a support that moves", "kind = \"roller\"", "kind = \"roller\"\nu = \"0.1*t\"", "33:5",
     "support[1].u: the material that moves with this support leaves its face of the grid from phase to phase; take a "
     "[[wall]]"},
    {"an exact answer", "[output]", "[exact]\nu = [\"x\", \"y\"]\n[output]", "44:5",
     "exact.u: is a function of undeformed positions, which later phases do not know"},
    {"backwards", "1.5", "4.5", "44:19", "output.stages[2]: must be later than the time before it, 4.5, not 3.5"},
    {"before the beginning", "[0, 1.5", "[-1, 1.5", "44:11", "output.stages[0]: must be at least 0, not -1"},
    {"one stage", "stages = [0, 1.5, \"angle/10\"]", "stages = 1", "44:10",
     "expected an array of numbers, found the number 1"},
    {"fields before", "stages = [", "fields_every = -1\nstages = [", "44:16",
     "output.fields_every: must be at least 0"},
    {"no such probe", "\"slope_angle\"", "\"slope_angel\"", "47:8", "did you mean 'slope_angle'?"},
    {"a place of the slope", "\"slope_angle\"", "\"slope_angle\"\nat = [0, 0]", "48:6",
     "probe[0].at: goes with a point only"},
    {"fields of the slope", "\"slope_angle\"", "\"slope_angle\"\nfields = [\"u.x\"]", "48:10",
     "probe[0].fields: goes with a point only"},
    {"u of a place in space", "fields = [\"u.x\"", "frame = \"space\"\nfields = [\"u.x\"", "52:11",
     "a place that stays has no displacement"},
    {"probe outside", "at = [8, 0]", "at = [8, 3.5]", "50:10", "probe[1].at[1]: 3.5 lies outside the body, 0 to 3"},
    {"no such point", "at = [8, 0]", "point = 97", "50:9", "there are 96 material points, so 97 is too large"},
    {"a line's field", "\"u.x\"", "\"u\"", "51:11", "probe[1].fields[0]: unknown field 'u'; expected one of u.x, u.y"},
    {"a component too far", "\"u.x\"", "\"u.z\"", "51:11", "unknown field 'u.z'; did you mean 'u.x'?"},
    {"a field twice", "\"stress.yy\"", "\"u.x\"", "51:18", "'u.x' is there already"},
};

}  // namespace

TEST_CASE("the plane scene that the tests break is good") {
  const TemporaryFolder folder;
  REQUIRE_NOTHROW(load_scene(folder.write("good.toml", kGoodPlane)));
}

TEST_CASE("each of over 30 broken grids and bodies of a plane gives one problem at its place") {
  check_each(kBadGridsAndBodies, kGoodPlane);
}

TEST_CASE("each of over 25 broken supports, walls and loads of a plane gives one problem at its place") {
  check_each(kBadLoads, kGoodPlane);
}

TEST_CASE("each of over 20 broken phases, masses, stages and probes of a plane gives one problem at its place") {
  check_each(kBadPhasesAndOutput, kGoodPlane);
}

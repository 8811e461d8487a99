// What lies in another body without being felt is found at the end: no such state is an equilibrium.
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "says.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace stillpoint::test {
namespace {

using scenes::run_text;

const std::string pad_rubber = "[material.m]\nlaw = \"neo-hookean\"\nE = 1e6\nnu = 0.3\nrho = 1000\n";
const std::string to_rest = "[damping]\nstrategy = \"auto\"\n[stop]\nsteps = 200000\n";

// A pad of 16 × 8 cells, into which a smooth disc is pushed from where it touches the top.
const std::string pad = R"toml(
dim = 2
[constants]
push = 0.3
T = 1
R = 0.3
at = 2.125
[grid]
min = [0, 0]
max = [4, 4]
cells = [16, 16]
[[body]]
name = "pad"
max = [4, 2]
material = "m"
placement = "gauss"
[[support]]
face = "bottom"
)toml" + pad_rubber;
const std::string disc =
    "[[rigid]]\nname = \"pin\"\ndisc = [\"at\", \"2+R\"]\nradius = \"R\"\nmotion = [\"0\", \"-push*min(t/T,1)\"]\n";

/// The number of cells after these words of a note; NaN: no note has them.
double depth_told(const Summary& s, const std::string& words) {
  for (const std::string& note : s.notes)
    if (note.starts_with(words)) return std::stod(note.substr(words.size()));
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TEST_CASE(
    "a disc that has jumped past the border of a body is at no equilibrium in its middle, in the plane or in space") {
  const Summary pressed = run_text(pad + disc + to_rest, {"constants.push=0.4"});
  CHECK(pressed.status == RunStatus::equilibrium);
  CHECK(pressed.contacts.at("pin.force_y") < -2e5);
  CHECK_FALSE(says(pressed, "past the border"));
  for (const char* law : {"neo-hookean", "linear-elastic"}) {
    CAPTURE(law);
    const Summary past = run_text(pad + disc + to_rest, {"constants.push=1.4", std::string("material.m.law=") + law});
    CHECK(past.status != RunStatus::equilibrium);
    CHECK_THAT(past.reason, Contains("'pin' has gone past the border of 'pad'"));
  }
}

TEST_CASE(
    "a rigid body that jumps right through a bridge ends the run, which says so, and one that jumps beside it does "
    "not") {
  const auto jumps = [](double x) {
    return run_text(
        fmt::format("dim = 2\n[grid]\nmin = [0, 0]\nmax = [2, 1.5]\ncells = [16, 12]\n[[body]]\nname = "
                    "'bridge'\nmin = [0, 0.5]\nmax = [1, 0.63]\nmaterial = 'm'\nplacement = 'gauss'\n"
                    "[[support]]\nface = 'left'\n[[rigid]]\nname = 'ram'\nmin = [{}, 0.7]\nmax = [{}, 0.9]\n"
                    "motion = [0, '-0.6*min(max(1e7*(t-0.001),0),1)']\n",
                    x, x + 0.4) +
        pad_rubber + to_rest);
  };
  const Summary through = jumps(0.3);
  CAPTURE(through.reason);
  CHECK(through.status == RunStatus::failed);
  CHECK_THAT(through.reason, Contains("'ram' has gone right through 'bridge'"));
  CHECK(jumps(1.3).status == RunStatus::equilibrium);
}

TEST_CASE("a disc that is pressed far into rubber ends with one force, however fast it comes") {
  std::vector<double> forces;
  for (const char* T : {"constants.T=1", "constants.T=10"}) {
    const Summary s = run_text(pad + disc + to_rest, {"constants.push=1", T});
    CHECK(s.status == RunStatus::equilibrium);
    forces.push_back(s.contacts.at("pin.force_y"));
  }
  CHECK(forces[0] < -1e5);
  CHECK(forces[0] == Approx(forces[1]).epsilon(1e-5));  // 3e-7
}

TEST_CASE("a pin that goes in between two places that feel contact is found by the material that lies in it") {
  const Summary in = run_text(pad + disc + to_rest, {"constants.R=0.1", "constants.push=0.5"});
  CAPTURE(in.reason);
  CHECK(in.status != RunStatus::equilibrium);
  CHECK_THAT(in.reason, Contains("'pin'") && Contains("'pad'"));
}

TEST_CASE("a corner of a body that has entered a floor unfelt is found with its depth, whatever is pressed beside it") {
  // The places that feel contact nearest to a corner of 90° on its tip are 0.21 cells from it, and 0.15 above it.
  for (const double top : {1.0, 1.1}) {
    for (const double up : {0.01, 0.1}) {
      CAPTURE(top, up);
      const Summary s = run_text(fmt::format(R"toml(
dim = 2
[grid]
min = [0, 0]
max = [4, 4]
cells = [16, 16]
[[body]]
name = "tip"
polygon = [[2, {0}], [4, {1}], [4, 4], [0, 4], [0, {1}]]
material = "m"
[[support]]
face = "top"
[[rigid]]
name = "floor"
half_plane = [[0, {0}], [0, 1]]
motion = ["0", "{2}*min(t,1)"]
[[probe]]
name = "corner"
at = [2, {3}]
fields = ["u.y"]
)toml",
                                             top, top + 2, up, top + 1e-9) +
                                 pad_rubber + to_rest);
      REQUIRE(s.status == RunStatus::equilibrium);
      const double cells = (up - scenes::probe(s, "corner", "u.y")) / 0.25;
      CAPTURE(cells, s.notes);
      CHECK(cells < 0.2);
      CHECK((s.contacts.at("floor.force_y") > 0) == (up == 0.1));
      const double told = depth_told(s, "'floor' reaches ");
      CHECK(told == Approx(cells).margin(0.03));  // the border beside the corner is deformed
    }
  }
}

TEST_CASE("free rigid bodies that stand in each other are at no equilibrium") {
  const std::string boxes =
      "[[rigid]]\nname = \"low\"\nmin = [1.5, 2]\nmax = [2.5, 2.3]\nfree = true\nmass = 100\n"
      "[[rigid]]\nname = \"up\"\nmin = [1.5, 2.3]\nmax = [2.5, 2.6]\nfree = true\nmass = 200\n"
      "[body_force]\nvalue = [0, -10]\n";
  const Summary stack = run_text(pad + boxes + to_rest);
  CHECK(stack.status != RunStatus::equilibrium);
  CHECK_THAT(stack.reason, Contains("'up' and 'low' are in each other"));
  // With a body between them they are not.
  const std::string apart =
      "[[rigid]]\nname = \"low\"\nmin = [0.5, 2]\nmax = [1.5, 2.3]\nfree = true\nmass = 100\n"
      "[[rigid]]\nname = \"up\"\nmin = [2.5, 2]\nmax = [3.5, 2.3]\nfree = true\nmass = 200\n"
      "[body_force]\nvalue = [0, -10]\n";
  CHECK(run_text(pad + apart + to_rest).status == RunStatus::equilibrium);
}

TEST_CASE(
    "a slab of one cell that ends in the middle of another body is at no equilibrium, wherever the grid's lines are") {
  for (const char* y : {"1.5", "1.625"}) {
    CAPTURE(y);
    const std::string scene = std::string(R"toml(
dim = 2
[grid]
min = [0, 0]
max = [4, 3]
cells = [16, 12]
[[body]]
name = "base"
max = [2, 1]
material = "m"
placement = "gauss"
[[body]]
name = "slab"
min = [2.3, )toml") + y + "]\nmax = [3.3, \"" +
                              y + R"toml(+0.25"]
material = "m"
placement = "gauss"
[[rigid]]
name = "stop"
half_plane = [[0.5, 0], [1, 0]]
bodies = ["slab"]
[[rigid]]
name = "floor"
half_plane = [[0, 0.5], [0, 1]]
bodies = ["slab"]
[[contact]]
bodies = ["slab", "base"]
friction = 0.3
[[support]]
face = "bottom"
[body_force]
value = [-1, -0.5]
)toml";
    const Summary inside = run_text(scene + pad_rubber + to_rest);
    CHECK(inside.status != RunStatus::equilibrium);
    CHECK_THAT(inside.reason, Contains("'base' and 'slab' have gone through each other"));
  }
}

TEST_CASE("a block that has tipped over the edge of a shelf in a single phase does not hang from its underside") {
  const Summary hangs = run_text(R"toml(
dim = 2
[grid]
min = [0, 0]
max = [4, 3]
cells = [16, 12]
[[body]]
name = "shelf"
min = [0, 1.5]
max = [2, 1.75]
material = "m"
placement = "gauss"
[[body]]
name = "block"
min = [1.5, 1.75]
max = [3, 2.25]
material = "m"
placement = "gauss"
[[contact]]
bodies = ["block", "shelf"]
friction = 0.5
[[support]]
face = "left"
[body_force]
value = [0, -0.2]
)toml" + pad_rubber + to_rest);
  CHECK(hangs.status != RunStatus::equilibrium);
  CHECK_THAT(hangs.reason, Contains("have turned by"));
}

TEST_CASE("a tower of a law of small strains that leans by 30 degrees says that its rotation is beyond the law") {
  const std::string tower = R"toml(
dim = 2
[grid]
min = [-0.5, -0.5]
max = [2, 2.5]
cells = [20, 24]
[[body]]
min = [0, 0]
max = [0.5, 2]
material = "m"
placement = "gauss"
[material.m]
law = "linear-elastic"
E = 1e7
nu = 0
rho = 1000
[[rigid]]
name = "floor"
half_plane = [[0, 0], [0, 1]]
friction = "rough"
[[rigid]]
name = "wall"
half_plane = [[1.5, 0], [-1, 0]]
[body_force]
value = [4, -10]
)toml";
  CHECK(says(run_text(tower + to_rest), "takes a rotation for a strain"));
  CHECK_FALSE(says(run_text(tower + to_rest, {"material.m.law=neo-hookean"}), "takes a rotation for a strain"));
  CHECK_FALSE(says(run_text(tower + to_rest, {"body_force.value=[0.1, -10]"}), "takes a rotation for a strain"));
}

TEST_CASE("a force that about two places of a border bear is told to be known to a tenth at best, on any way to rest") {
  // A tilted face comes down on a block with its corner: on 16 cells there are two states of rest, 20 % apart.
  const std::string edge = R"toml(
dim = 2
[grid]
min = [0, 0]
max = [2, 1.5]
cells = [16, 12]
[[body]]
max = [2, 0.97]
material = "m"
[[support]]
face = "bottom"
[[rigid]]
name = "punch"
polygon = [[0.63, 0.98], [1.41, 1.09], [1.39, 1.4], [0.6, 1.3]]
motion = ["0", "-0.03*min(t, 0.05)/0.05"]
)toml" + pad_rubber;
  const std::string at_once = "rigid[0].motion=['0', '-0.03']";
  const Summary moved = run_text(edge + to_rest), sudden = run_text(edge + to_rest, {at_once}),
                newton = run_text(edge, {at_once, "solve.method=newton"});
  const auto force = [](const Summary& summary) { return summary.contacts.at("punch.force_y"); };
  CHECK(force(moved) == Approx(force(newton)).epsilon(1e-3));
  CHECK(std::abs(force(sudden) - force(newton)) > 0.1 * std::abs(force(newton)));  // or the note is for nothing
  for (const Summary& summary : {moved, sudden, newton}) CHECK(says(summary, "'punch' is borne by"));

  // A flat face that is felt all along, and a block that is no wider than a cell and is touched all over, are exact.
  const std::vector<std::string> flat{"rigid[0].polygon=[[0.5, 0.98], [1.5, 0.98], [1.5, 1.4], [0.5, 1.4]]"};
  CHECK_FALSE(says(run_text(edge + to_rest, flat), "is borne by"));
  CHECK_FALSE(says(run_text(edge + to_rest, scenes::with(flat, {"body[0].min=[1, 0]", "body[0].max=[1.125, 0.97]"})),
                   "is borne by"));
}

}  // namespace stillpoint::test

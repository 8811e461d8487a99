// What nothing holds is at no equilibrium, and neither is what only a corner holds that no border would bear.
#include <cmath>
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

const std::string block_rubber = "[material.m]\nlaw = 'neo-hookean'\nE = 1e6\nnu = 0.3\nrho = 1000\n";
const std::string stop = "[stop]\nsteps = 20000\n", by_auto = "[damping]\nstrategy = 'auto'\n" + stop;

/// A rigid box of 1 by 0.5 on an incline of 0.2, whose lower corner is at x_0.
std::string box_on_incline(double x_0, const std::string& more) {
  const double theta = 0.2, c = std::cos(theta), s = std::sin(theta), low = 0.3, a = x_0 / c;
  const auto at = [&](double along, double above) {
    return fmt::format("[{:.12f}, {:.12f}]", along * c - above * s, low + along * s + above * c);
  };
  return fmt::format(
             "dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 3.5]\ncells = [16, 14]\n"
             "[[body]]\nname = 'pad'\npolygon = [[0, 0], [4, 0], [4, {}], [0, {}]]\nmaterial = 'm'\n"
             "[[support]]\nface = 'bottom'\n"
             "[[rigid]]\nname = 'box'\npolygon = [{}, {}, {}, {}]\nfree = true\nmass = 500\n{}\n"
             "[body_force]\nvalue = [0, -10]\n",
             low + 4 * s / c, low, at(a, 0), at(a + 1, 0), at(a + 1, 0.5), at(a, 0.5), more) +
         block_rubber + by_auto;
}

/// A block between two plates that stand at its sides.
std::string between_plates(const std::string& more, const std::string& way = by_auto) {
  return "dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 4]\ncells = [16, 16]\n"
         "[[body]]\nname = 'block'\nmin = [1, 1]\nmax = [2, 2]\nmaterial = 'm'\nplacement = 'gauss'\n"
         "[[rigid]]\nname = 'left'\nhalf_plane = [[1, 0], [1, 0]]\n"
         "[[rigid]]\nname = 'right'\nhalf_plane = [[2, 0], [-1, 0]]\n"
         "[body_force]\nvalue = [0, -10]\n" +
         more + block_rubber + way;
}

/// A block above a base.
const std::string above_base =
    "dim = 2\n[constants]\ng = -10\n[grid]\nmin = [0, 0]\nmax = [4, 3]\ncells = [16, 12]\n"
    "[[body]]\nname = 'base'\nmax = [4, 1]\nmaterial = 'm'\nplacement = 'gauss'\n"
    "[[body]]\nname = 'block'\nmin = [1, 1.5]\nmax = [2, 2.25]\nmaterial = 'm'\nplacement = 'gauss'\n"
    "[[contact]]\nbodies = ['block', 'base']\nfriction = 0.3\n[[support]]\nface = 'bottom'\n"
    "[body_force]\nvalue = [0, 'g']\n" +
    block_rubber + by_auto;

void check_moves_away(const Summary& s, const std::string& who, const std::string& along) {
  CAPTURE(s.reason);
  CHECK(s.status == RunStatus::failed);
  CHECK(s.exit_status == 4);
  CHECK_THAT(s.reason, Contains(fmt::format("{} is held by nothing along {} and moves away", who, along)));
  CHECK(s.rhs_evaluations < 1000);
}

/// A rigid box that is pressed on a block and dragged along it, so that its corner hooks behind places of the block's
/// top.
std::string dragged_box(const std::string& more) {
  return "dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 2]\ncells = [16, 8]\n[body]\nmax = [4, 1]\nmaterial = 'm'\n"
         "placement = 'gauss'\n[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1000\n"
         "[[support]]\nface = 'bottom'\n[[rigid]]\nname = 'box'\nmin = [1.5, 1.0]\nmax = [2.5, 1.8]\n"
         "motion = ['0.1', '-0.05']\n" +
         more + "\n" + by_auto;
}

}  // namespace

TEST_CASE("a free box on a smooth incline comes to no rest behind the places that its sharp corner meets") {
  for (const double x_0 : {1.2, 1.45, 1.6}) {
    CAPTURE(x_0);
    const Summary s = run_text(box_on_incline(x_0, ""));
    CAPTURE(s.reason);
    CHECK(s.status != RunStatus::equilibrium);
    CHECK_THAT(s.reason, Contains("'box' is held by a sharp corner") || Contains("'box' is held by nothing along"));
  }
  // With friction that is enough it rests by that.
  CHECK(run_text(box_on_incline(1.2, "friction = 0.25")).status == RunStatus::equilibrium);
}

TEST_CASE("a block that slides on a rigid plane for ever ends the run, which says that it slides and along what") {
  for (const char* strategy : {"viscous", "auto", "kinetic", "fire"}) {
    CAPTURE(strategy);
    const Summary s = run(scenes::load("ladder/incline", {"rigid[0].friction=0.25", "stop.residual=1e-6", "stop.time=0",
                                                          fmt::format("damping.strategy={}", strategy)}));
    CHECK(s.status == RunStatus::step_limit);
    CHECK_THAT(s.reason, Contains("it slides: along rigid body 'slope', 100 % of the body"));
    CHECK(s.rhs_evaluations < 100'000);
  }
}

TEST_CASE("a block that lacks little friction, and sticks now and then, slides and a static solver has lost it") {
  const std::vector<std::string> nearly{"rigid[0].friction=0.996*tan(theta)", "stop.residual=1e-7", "stop.time=0"};
  const Summary sticks =
      run(scenes::load("ladder/incline", scenes::with(nearly, {"damping.strategy=auto", "stop.steps=1000000"})));
  CHECK_THAT(sticks.reason, Contains("it slides: along rigid body 'slope', 100 % of the body"));
  CHECK(sticks.rhs_evaluations < 500'000);
  const Summary lost = run(scenes::load("ladder/incline", scenes::with(nearly, {"solve.method=lbfgs"})));
  CHECK(lost.status == RunStatus::failed);
  CHECK_THAT(lost.reason, Contains("times the length of the grid, and nothing brings it to rest"));
}

TEST_CASE(
    "a smooth round free body that is pushed along a border comes to no rest between two places that feel contact") {
  const auto ground = [](const char* body, const char* rigid, const char* cells) {
    return fmt::format(
               "dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 1.5]\ncells = {}\n[body]\n{}\nmaterial = 'm'\n"
               "placement = 'gauss'\n[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1\n"
               "[[support]]\nface = 'bottom'\n[[rigid]]\nname = 'disc'\nradius = 0.5\nfree = true\n{}\n",
               cells, body, rigid) +
           "[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-8\n";
  };
  const char* const flat = "min = [0, 0]\nmax = [4, 1.03]";
  for (const char* cells : {"[32, 12]", "[64, 24]"}) {
    CAPTURE(cells);
    const Summary pushed = run_text(ground(flat, "disc = [1.0, 1.55]\nforce = [1, -100]", cells));
    CAPTURE(pushed.reason);
    CHECK(pushed.status != RunStatus::equilibrium);
    CHECK_THAT(pushed.reason, Contains("'disc' is held in between the few places") || Contains("is held by nothing"));
  }
  // Straight down it may stand anywhere, friction bears a push, and so do the two sides of a groove.
  for (const char* rigid : {"disc = [1.0, 1.55]\nforce = [0, -100]", "disc = [2.03, 1.55]\nforce = [0, -100]",
                            "disc = [1.0, 1.55]\nforce = [1, -100]\nfriction = 0.3"}) {
    CAPTURE(rigid);
    CHECK(run_text(ground(flat, rigid, "[32, 12]")).status == RunStatus::equilibrium);
  }
  const Summary in_groove =
      run_text(ground("polygon = [[0, 0], [4, 0], [4, 1.4], [3, 1.4], [2, 0.4], [1, 1.4], [0, 1.4]]",
                      "disc = [2.0, 1.15]\nforce = [30, -100]", "[32, 12]"));
  CAPTURE(in_groove.reason);
  CHECK(in_groove.status == RunStatus::equilibrium);
}

TEST_CASE("a driven rigid body whose sharp corner drags a border says by how much its force is off") {
  // A box that is pushed along a block behind the places of its top that feel contact.
  const Summary s = run_text(dragged_box(""));
  CHECK(says(s, "a sharp corner of 'box' pushes the places of a border"));
  CHECK_FALSE(says(run_text(dragged_box("rounding = 0.15")), "a sharp corner of"));
}

TEST_CASE("a half-plane that pushes a block beside the block's own corner is not told to have a sharp corner") {
  const Summary s = run_text(
      "dim = 2\n[grid]\nmin = [-0.6, -0.6]\nmax = [1.6, 1.6]\ncells = [22, 22]\n[[body]]\nname = 'block'\n"
      "min = [0.1, 0.02]\nmax = [0.6, 0.33]\nmaterial = 'm'\nplacement = 'gauss'\n"
      "[[rigid]]\nname = 'slope'\nhalf_plane = [[0, 0.02], [0, 1]]\nabout = [0, 0.02]\n"
      "rotation = '0.44*min(t,1)'\nfriction = 0.5\n[body_force]\nvalue = [0, -10]\n[phase]\nmax_motion = 0.1\n" +
      block_rubber + "[damping]\nstrategy = 'viscous'\nc = 40\n[stop]\nresidual = 1e-6\ntime = 6\n");
  CHECK_FALSE(says(s, "a sharp corner of"));
}

TEST_CASE("a block that falls between smooth plates is told soon to be held by nothing along them") {
  check_moves_away(run_text(between_plates("")), "'block'", "y");
  // A floor ahead, however far, and rough plates are something.
  const Summary caught = run_text(between_plates("[[rigid]]\nname = 'floor'\nhalf_plane = [[0, -0.5], [0, 1]]\n"));
  CAPTURE(caught.reason);
  CHECK(caught.status == RunStatus::equilibrium);
}

TEST_CASE("bodies that nothing holds are told by static solvers as well") {
  for (const char* method : {"newton", "lbfgs"}) {
    CAPTURE(method);
    const Summary s = run_text(between_plates("", fmt::format("[solve]\nmethod = '{}'\n", method) + stop));
    CHECK(s.status != RunStatus::equilibrium);
    CHECK((says(s, "'block' is held by nothing along y") ||
           s.reason.find("'block' is held by nothing along y") != std::string::npos));
  }
}

TEST_CASE("a static solver that finds no rest of a block that friction holds names the relaxation, which finds one") {
  const std::string pushed =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [2, 1.5]\ncells = [16, 12]\n[[body]]\nname = 'block'\n"
      "min = [0.5, 0.53]\nmax = [1.5, 0.83]\nmaterial = 'm'\nplacement = 'gauss'\n"
      "[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1\n"
      "[[rigid]]\nname = 'floor'\nhalf_plane = [[0, 0.53], [0, 1]]\nfriction = 0.3\n"
      "[[traction]]\nline = [[0.5, 0.83], [1.5, 0.83]]\nvalue = [20, -1000]\n[stop]\nresidual = 1e-7\n";
  const Summary by_newton = run_text(pushed + "[solve]\nmethod = 'newton'\n");
  CAPTURE(by_newton.reason);
  CHECK((by_newton.status == RunStatus::equilibrium ||
         by_newton.reason.find("solve.method = \"relaxation\"") != std::string::npos));
  CHECK(run_text(pushed + "[damping]\nstrategy = 'auto'\n").status == RunStatus::equilibrium);
}

TEST_CASE("a block that its load lifts off a base moves away, and one that falls on it comes to rest") {
  check_moves_away(run_text(above_base, {"constants.g=10"}), "'block'", "y");
  CHECK(run_text(above_base).status == RunStatus::equilibrium);
}

TEST_CASE(
    "a body that falls is told to do so wherever its border lies in its cells, as where functions follow others") {
  const std::string below_a_roof =
      "dim = 2\n[constants]\nover = 0\n[grid]\nmin = [0, 0]\nmax = [4, 4]\ncells = [16, 16]\n"
      "[[body]]\nname = 'block'\nmin = ['1-over', 1]\nmax = ['2+over', 2]\nmaterial = 'm'\nplacement = 'gauss'\n"
      "[[rigid]]\nname = 'roof'\nmin = [0.5, 3]\nmax = [2.5, 3.5]\n[body_force]\nvalue = [0, -10]\n" +
      block_rubber + by_auto;
  for (const char* over : {"constants.over=0", "constants.over=1e-5", "constants.over=1e-3", "constants.over=0.02"}) {
    CAPTURE(over);
    check_moves_away(run_text(below_a_roof, {over}), "'block'", "y");
  }
}

TEST_CASE("a free rigid body with nothing on its way is told to move away, and its displacement stays a length") {
  const std::string free_box =
      "dim = 2\n[constants]\ng = 10\n[grid]\nmin = [0, 0]\nmax = [4, 3]\ncells = [16, 12]\n"
      "[[body]]\nname = 'pad'\nmax = [4, 1]\nmaterial = 'm'\nplacement = 'gauss'\n[[support]]\nface = 'bottom'\n"
      "[[rigid]]\nname = 'box'\nmin = [1.5, 1.5]\nmax = [2.5, 2]\nfree = true\nmass = 500\n"
      "[body_force]\nvalue = [0, 'g']\n" +
      block_rubber + by_auto;
  const Summary s = run_text(free_box);
  check_moves_away(s, "'box'", "y");
  CHECK(s.contacts.at("box.displacement_y") < 1e5);
  CHECK(run_text(free_box, {"constants.g=-10"}).status == RunStatus::equilibrium);
  // From however far above it comes down.
  CHECK(run_text(free_box, {"constants.g=-10", "rigid[0].min=[1.5, 501.5]", "rigid[0].max=[2.5, 502]"}).status ==
        RunStatus::equilibrium);
  // A run until a time goes on.
  CHECK(run_text(free_box, {"stop.residual=0", "stop.time=0.1"}).status == RunStatus::end_time);
}

}  // namespace stillpoint::test

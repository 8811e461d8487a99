// Bodies that lie in each other, and rigid ones with thin parts in them: either the contact bears it, or it is told.
#include <cmath>
#include <string>
#include <utility>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "says.hpp"
#include "scenes.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

using scenes::run_text;

const std::string soft_rubber =
    "[material.m]\nlaw = 'neo-hookean'\nE = 1e5\nnu = 'nu'\nrho = 1000\n[damping]\nstrategy = 'auto'\n";

// A base of 10 × 5 cells, and a block beside it that supports move by w past its edge and down by d.
const std::string beside_a_base =
    "dim = 2\n[constants]\nd = 0.08\nw = 0.1\nnu = 0.3\n[grid]\nmin = [0, 0]\nmax = [2, 0.8]\ncells = [20, 8]\n"
    "[[body]]\nname = 'base'\nmax = [1, 0.5]\nmaterial = 'm'\n"
    "[[body]]\nname = 'block'\nmin = [1.1, 0.5]\nmax = [1.6, 0.8]\nmaterial = 'm'\n"
    "[[contact]]\nbodies = ['block', 'base']\n[[support]]\nface = 'bottom'\n"
    "[[support]]\nface = 'top'\ncomponent = 'x'\nu = '-0.1-w'\n[[support]]\nface = 'top'\ncomponent = 'y'\nu = '-d'\n" +
    soft_rubber;

// A sheet of 0.3 cells, bonded to a base, and a block from yb up to a fixed top.
std::string on_a_sheet(const std::string& pair) {
  return "dim = 2\n[constants]\nyb = 0.51\nnu = 0\n[grid]\nmin = [0, 0]\nmax = [1, 1]\ncells = [10, 10]\n"
         "[[body]]\nname = 'base'\nmax = [1, 0.5]\nmaterial = 'm'\n"
         "[[body]]\nname = 'sheet'\nmin = [0, 0.5]\nmax = [1, 0.53]\nmaterial = 'm'\n"
         "[[body]]\nname = 'block'\nmin = [0, 'yb']\nmax = [1, 1]\nmaterial = 'm'\n"
         "[[contact]]\nbodies = " +
         pair +
         "\n[[contact]]\nbodies = ['block', 'base']\n"
         "[[support]]\nface = 'bottom'\n[[support]]\nface = 'top'\n" +
         soft_rubber;
}

// A block of 10 × 10 cells and a rigid T from x0 on, whose blade of 0.15 cells reaches half a metre before it.
const std::string tee =
    "dim = 2\n[constants]\nx0 = 1.56\nh = 0.0075\nway = -0.57\nnu = 0.3\n"
    "[grid]\nmin = [0, 0]\nmax = [2, 1]\ncells = [20, 10]\n"
    "[[body]]\nname = 'block'\nmax = [1, 1]\nmaterial = 'm'\n[[support]]\nface = 'left'\n"
    "[[rigid]]\nname = 'tee'\npolygon = [['x0', 0], ['x0+0.3', 0], ['x0+0.3', 1], ['x0', 1], ['x0', '0.5+h'], "
    "['x0-0.5', '0.5+h'], ['x0-0.5', '0.5-h'], ['x0', '0.5-h']]\nmotion = ['way*min(t,1)', '0']\n" +
    soft_rubber;

}  // namespace

TEST_CASE("bodies that come into each other where their borders were not opposite are at no equilibrium") {
  for (const char* depth : {"constants.d=0.04", "constants.d=0.07"}) {  // 0.4 and 0.7 cells
    CAPTURE(depth);
    const Summary s = run_text(beside_a_base, {"constants.w=0.4", depth});
    CHECK(s.status != RunStatus::equilibrium);
    CHECK(says(s, "'block' and 'base' lie in each other by"));
  }
  // One that stays beside the base does not touch it, and one that was above it from the start presses on it.
  CHECK(run_text(beside_a_base, {"constants.w=-0.05"}).status == RunStatus::equilibrium);
  const Summary pressed = run_text(
      beside_a_base, {"constants.w=-0.1", "constants.d=0.04", "body[1].min=[0.5, 0.5]", "body[1].max=[0.9, 0.8]"});
  CHECK(pressed.status == RunStatus::equilibrium);
  CHECK(pressed.contacts.at("block+base.force_y") > 500);
}

TEST_CASE(
    "a block presses on a sheet thinner than twice their overlap as on a thick one, whichever of them is named first") {
  constexpr double E = 1e5, top = 0.53;
  for (const double yb : {0.525, 0.516, 0.514, 0.51, 0.505}) {
    for (const auto& [pair, sign] :
         {std::pair<std::string, double>{"['block', 'sheet']", 1}, {"['sheet', 'block']", -1}}) {
      CAPTURE(yb, pair);
      const Summary s = run_text(on_a_sheet(pair), {fmt::format("constants.yb={}", yb)});
      CHECK(s.status == RunStatus::equilibrium);
      const std::string name = sign > 0 ? "block+sheet" : "sheet+block";
      // Strains of up to 3 % around the overlap over the length of all.
      CHECK(std::abs(s.contacts.at(name + ".force_y")) == Approx(E * (top - yb)).epsilon(0.04));
    }
  }
}

TEST_CASE("the blade of a rigid body that has gone in between two places of a border is told, and none may begin so") {
  CHECK_THROWS_WITH(run_text(tee, {"constants.x0=1.01", "constants.way=-0.02"}),
                    Catch::Contains("'tee' is inside body[0]: its corner at (0.51, "));
  const Summary driven = run_text(tee);
  CAPTURE(driven.reason);
  CHECK(driven.status != RunStatus::equilibrium);
  CHECK(says(driven, "'tee' has gone in between the places of the border of 'block' that feel contact"));
  CHECK(says(driven, "the rigid body 'tee' is 0.15 cells wide where it is thinnest"));
}

}  // namespace stillpoint::test

// Bodies that lie in each other, and rigid ones with thin parts in them: either the contact bears it, or it is told.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

// A slab that supports at its left end bring into a base beside it, by w and down by d.
std::string slab_and_base(int dim, const std::string& pair) {
  const bool space = dim == 3;
  const std::string z = space ? ", 0" : "", depth = space ? ", 0.4" : "";
  return fmt::format(
             "dim = {}\n[constants]\nh = 0.08\nw = 0.6\nd = 0.36\nnu = 0.3\n[grid]\nmin = [-0.8, 0{}]\nmax = [1.2, "
             "0.8{}]\n"
             "cells = [20, 8{}]\n[[body]]\nname = 'base'\nmin = [0, 0{}]\nmax = [0.5, 0.5{}]\nmaterial = 'm'\n"
             "[[body]]\nname = 'slab'\nmin = [-0.8, 0.55{}]\nmax = [-0.02, '0.55+h'{}]\nmaterial = 'm'\n"
             "[[contact]]\nbodies = {}\n[[support]]\nface = 'bottom'\n"
             "[[support]]\nface = 'left'\ncomponent = 'x'\nu = 'w*min(t,1)'\n"
             "[[support]]\nface = 'left'\ncomponent = 'y'\nu = '-d*min(t,1)'\n{}",
             dim, z, depth, space ? ", 4" : "", z, depth, z, depth, pair,
             space ? "[[support]]\nface = 'left'\ncomponent = 'z'\n" : "") +
         soft_rubber;
}

// A block that supports at its top bring down by d beside a step, and along by w, from x0 and y0 on.
const std::string beside_a_step =
    "dim = 2\n[constants]\nw = 0.274\nd = 0.51\nx0 = 0.3\ny0 = 0.8\nnu = 0.3\n"
    "[grid]\nmin = [0, 0]\nmax = [2, 1.2]\ncells = [20, 12]\n"
    "[[body]]\nname = 'base'\npolygon = [[0, 0], [2, 0], [2, 0.7], [1, 0.7], [1, 0.3], [0, 0.3]]\nmaterial = 'm'\n"
    "placement = 'gauss'\n"
    "[[body]]\nname = 'block'\nmin = ['x0', 'y0']\nmax = ['x0+0.45', 1.2]\nmaterial = 'm'\nplacement = 'gauss'\n"
    "[[contact]]\nbodies = ['block', 'base']\n[[support]]\nface = 'bottom'\n"
    "[[support]]\nface = 'top'\ncomponent = 'x'\nu = 'w*min(t,1)'\n"
    "[[support]]\nface = 'top'\ncomponent = 'y'\nu = '-d*min(t,1)'\n" +
    soft_rubber;

// A block of 5 × 5 cells, and a rigid blade of 0.3 cells that moves to it, and into it or through it.
const std::string blade =
    "dim = 2\n[constants]\nw = 0.3\nnu = 0.3\n[grid]\nmin = [-1, 0]\nmax = [2, 0.8]\ncells = [30, 8]\n"
    "[[body]]\nname = 'base'\nmin = [0, 0]\nmax = [0.5, 0.5]\nmaterial = 'm'\n[[support]]\nface = 'bottom'\n"
    "[[rigid]]\nname = 'blade'\npolygon = [[-0.9, 0.235], [-0.02, 0.235], [-0.02, 0.265], [-0.9, 0.265]]\n"
    "motion = ['w*min(t,1)', '0']\n" +
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

TEST_CASE("a slab that lies deep in another body, or has gone through it, is told, whatever side is nearest") {
  for (const char* pair : {"['slab', 'base']", "['base', 'slab']"}) {
    for (const char* w : {"constants.w=0.3", "constants.w=0.6", "constants.w=0.7"}) {
      for (const auto& [h, d] : {std::pair<const char*, const char*>{"constants.h=0.08", "constants.d=0.36"},
                                 {"constants.h=0.08", "constants.d=0.3"},
                                 {"constants.h=0.1", "constants.d=0.38"},
                                 {"constants.h=0.03", "constants.d=0.3"}}) {
        CAPTURE(pair, w, h, d);
        const Summary s = run_text(slab_and_base(2, pair), {w, h, d});
        CHECK(s.status != RunStatus::equilibrium);
        CHECK((says(s, "lie in each other by") || says(s, "have gone through each other")));
      }
    }
    const Summary beside = run_text(slab_and_base(2, pair), {"constants.w=0", "constants.d=0.36"});
    CHECK(beside.status == RunStatus::equilibrium);
    CHECK_FALSE(says(beside, "in each other"));
  }
  const Summary in_space = run_text(slab_and_base(3, "['slab', 'base']"));
  CHECK(in_space.status != RunStatus::equilibrium);
  CHECK(says(in_space, "lie in each other by"));
}

TEST_CASE("what a body presses on with one side bears nothing of what it lies in with another one") {
  const Summary s = run_text(beside_a_step);
  CAPTURE(s.reason);
  CHECK(s.status != RunStatus::equilibrium);
  CHECK(says(s, "'block' and 'base' lie in each other by 0.2"));
  // The same places of both bodies, with borders that were opposite from the start.
  const Summary opposite =
      run_text(beside_a_step, {"constants.w=0.034", "constants.d=0.02", "constants.x0=0.54", "constants.y0=0.31"});
  CHECK(opposite.status == RunStatus::equilibrium);
  CHECK(opposite.contacts.at("block+base.force_x") < -200);
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
                    Catch::Contains("'tee' is inside body[0]: its surface at (0.51, "));
  const Summary driven = run_text(tee);
  CAPTURE(driven.reason);
  CHECK(driven.status != RunStatus::equilibrium);
  CHECK(says(driven, "'tee' has gone in between the places of the border of 'block' that feel contact"));
  CHECK(says(driven, "the rigid body 'tee' is 0.15 cells wide where it is thinnest"));
}

TEST_CASE("a thin rigid body in a body or right through it is at no equilibrium, with corners or without") {
  const std::string pin = "rigid=[{name='blade', disc=[-0.05, 0.25], radius=0.012, motion=['w*min(t,1)', '0']}]";
  for (const auto& set : {std::vector<std::string>{"constants.w=0.3"},
                          {"constants.w=0.8"},
                          {pin, "constants.w=0.2"},
                          {pin, "constants.w=0.3"}}) {
    CAPTURE(set);
    const Summary s = run_text(blade, set);
    CAPTURE(s.reason);
    CHECK(s.status != RunStatus::equilibrium);
    CHECK(says(s, "'blade' has gone in between the places of the border of 'base' that feel contact"));
  }
  for (const std::string& gone : {std::string("constants.w=0.01"), pin + ""}) {
    const Summary s = run_text(blade, {gone, "constants.w=0.01"});
    CHECK(s.status == RunStatus::equilibrium);
  }
}

}  // namespace stillpoint::test

// Contact between bodies against exact answers, and what has to be the same whichever way it is found.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

using scenes::run_ladder;

/// The largest error of the force between the blocks, and of the displacement of the upper one's top.
double error_of_blocks(const Summary& s, double E_2) {
  const double force = std::abs(s.contacts.at("block+base.force_y") - 1);
  const double top = -(0.95 / 100 + 0.95 / E_2);
  return std::max(force, std::abs(scenes::probe(s, "top", "u.y") / top - 1));
}

/// A smooth disc on a smooth block, with its weight and a share of it along the block.
std::string disc_on_block(double share, const std::string& pair, double x = 0.83) {
  constexpr int corners = 60;
  std::vector<std::string> disc;
  for (int k = 0; k < corners; ++k) {
    const double angle = std::numbers::pi * (2 * k + 1) / corners;
    disc.push_back(fmt::format("[{}, {}]", x + 0.3 * std::cos(angle), 0.58 + 0.3 * std::sin(angle)));
  }
  return fmt::format(
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [2, 1]\ncells = [64, 32]\n"
      "[[body]]\nname = 'block'\nmax = [2, 0.28]\nmaterial = 'm'\nplacement = 'gauss'\n"
      "[[body]]\nname = 'disc'\npolygon = [{}]\nmaterial = 'n'\nplacement = 'gauss'\n"
      "[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1\n"
      "[material.n]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1000\n"
      "[[support]]\nface = 'bottom'\n[[contact]]\nbodies = [{}]\n[body_force]\nvalue = [{}, -10]\n"
      "[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-6\n",
      fmt::join(disc, ", "), pair, 10 * share);
}

}  // namespace

TEST_CASE("two blocks of any stiffness bear a uniform stress where they touch off the grid, by every way to rest") {
  for (const double E_2 : {100.0, 1000.0, 1e5}) {
    const std::string stiffness = fmt::format("constants.E2={}", E_2);
    for (const char* strategy :
         {"viscous", "adaptive", "kinetic", "fire", "nesterov", "one-sided", "cundall", "auto"}) {
      if (E_2 > 100 && std::string(strategy) != "auto") continue;  // they take long
      CAPTURE(E_2, strategy);
      const Summary s = run_ladder("stacked_blocks", {stiffness, std::string("damping.strategy=") + strategy});
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(error_of_blocks(s, E_2) < 1e-7);  // a hundred residuals and more
    }
    for (const char* method : {"newton", "newton-cg", "lbfgs"}) {
      CAPTURE(E_2, method);
      const Summary s = run_ladder("stacked_blocks", {stiffness, std::string("solve.method=") + method});
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(error_of_blocks(s, E_2) < 1e-7);
    }
  }
}

TEST_CASE("a dragged block bears the same from cell to cell, however it is damped, and rubs with its share of that") {
  double mean_before = 0;
  for (const char* alpha : {"damping.alpha=0.3", "damping.alpha=0.05"}) {
    CAPTURE(alpha);
    const TemporaryFolder folder;
    const Summary s = run(scenes::load("hard/dragged_block", {alpha}), {.out = folder.path(), .threads = 1});
    REQUIRE(s.status == RunStatus::end_time);
    const auto history = columns_of(folder.path() / "history.csv");
    const std::vector<double>&t = history.at("t"), &N = history.at("block+base.force_y"),
          &T = history.at("block+base.force_x");
    double sum = 0, square = 0, rubbed = 0, count = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      if (t[k] < 5) continue;  // it starts with a jerk
      sum += N[k], square += N[k] * N[k], rubbed += T[k], count += 1;
    }
    REQUIRE(count > 100);
    const double mean = sum / count;
    CHECK(std::sqrt(square / count - mean * mean) < 0.01 * mean);  // the most that is asked of any dragged block
    CHECK(rubbed / sum == Approx(-0.3).epsilon(0.02));             // the base below bulges in front of it
    CHECK(s.contacts.at("block+base.slipping") == 1);
    // A motion that is never quiet is pressed by more than the penalty, which alone would bear a sixth less.
    if (mean_before != 0) CHECK(mean == Approx(mean_before).epsilon(0.005));
    mean_before = mean;
  }
}

TEST_CASE("a frictionless block that overhangs the edge of another one feels no force along it, in either order") {
  for (const char* order : {"['b', 'a']", "['a', 'b']"}) {
    for (const double way : {0.05, 0.2}) {
      CAPTURE(order, way);
      const test::TemporaryFolder folder;
      const Summary s =
          run(load_scene(folder.write(
                  "scene.toml",
                  fmt::format(
                      "dim = 2\n[grid]\nmin = [-1, 0]\nmax = [3, 3]\ncells = [16, 12]\n"
                      "[[body]]\nname = 'a'\nmaterial = 'r'\nplacement = 'gauss'\nmax = [1.5, 1.0]\n"
                      "[[body]]\nname = 'b'\nmaterial = 'r'\nplacement = 'gauss'\nmin = [0.9, 1.0]\nmax = [1.9, 1.5]\n"
                      "[material.r]\nlaw = 'hencky'\nE = 1000.0\nnu = 0.3\nrho = 1.0\n"
                      "[[contact]]\nbodies = {}\nfriction = 0\n[[support]]\nface = 'bottom'\n"
                      "[[rigid]]\nname = 'plate'\nhalf_plane = [[0, 1.5], [0, -1]]\n"
                      "motion = ['-{}*min(t/5,1)', '-0.02*min(t/5,1)']\nbodies = ['b']\nfriction = 'rough'\n"
                      "[phase]\nmax_motion = 0.1\n[damping]\nstrategy = 'cundall'\n[stop]\nresidual = 1e-6\n",
                      order, way))),
              {.threads = 1});
      CAPTURE(s.reason);
      const std::string pair = s.contacts.contains("b+a.force_x") ? "b+a" : "a+b";
      const double along = s.contacts.at(pair + ".force_x"), across = s.contacts.at(pair + ".force_y");
      REQUIRE(std::abs(across) > 5);
      CHECK(std::abs(along) < 0.03 * std::abs(across));  // the surfaces tilt under the edge
    }
  }
}

TEST_CASE("a traction on the side of one body loads that body, also beneath another one that it touches") {
  const Scene scene = load_scene("block.toml", R"(
dim = 2
grid = {min = [0, 0], max = [4, 3], cells = [16, 12]}
material.m = {law = "linear-elastic", E = 1e6, nu = 0.3, rho = 1000}
support = [{name = "floor", face = "bottom"}]
traction = [{line = [[1, 2], [2, 2]], value = [0, -1000]}, {line = [[0.5, 1], [2.5, 1]], value = [0, -1000]}]
contact = [{bodies = ["block", "base"], friction = 0.3}]
damping = {strategy = "auto"}
[[body]]
name = "base"
max = [4, 1]
material = "m"
placement = "gauss"
[[body]]
name = "block"
min = [1, 1]
max = [2, 2]
material = "m"
placement = "gauss"
)",
                                 {});
  const Summary s = run(scene, {.threads = 1});
  REQUIRE(s.status == RunStatus::equilibrium);
  CHECK(s.contacts.at("block+base.force_y") == Approx(1000).epsilon(1e-5));
  CHECK(s.reactions.at("floor")[1] == Approx(3000).epsilon(1e-5));
}

TEST_CASE("bodies that turn to each other within a single phase, and end in one place, are at no equilibrium") {
  const test::TemporaryFolder folder;
  const auto moved_by = [&](double way) {
    return run(
        load_scene(folder.write("scene.toml",
                                fmt::format("dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 3]\ncells = [16, 12]\n"
                                            "[[body]]\nname = 'arm'\nmaterial = 'r'\nmin = [0, 1.25]\nmax = [1, 1.75]\n"
                                            "[[body]]\nname = 'base'\nmaterial = 'r'\nmin = [1.5, 0]\nmax = [3, 1]\n"
                                            "[material.r]\nlaw = 'hencky'\nE = 1000.0\nnu = 0.3\nrho = 1.0\n"
                                            "[[contact]]\nbodies = ['arm', 'base']\n[[support]]\nface = 'bottom'\n"
                                            "[[support]]\nface = 'left'\ncomponent = 'x'\nu = '{0}*min(t/5,1)'\n"
                                            "[[support]]\nface = 'left'\ncomponent = 'y'\nu = '-{0}/2*min(t/5,1)'\n"
                                            "[phase]\nmax_motion = 'none'\n[damping]\nstrategy = 'cundall'\n"
                                            "[stop]\nresidual = 1e-6\n",
                                            way))),
        {.threads = 1});
  };
  CHECK(moved_by(0.3).status == RunStatus::equilibrium);
  const Summary through = moved_by(1.6);
  CHECK(through.status == RunStatus::step_limit);
  CHECK_THAT(through.reason, Catch::Contains("'arm' and 'base' have gone through each other"));
}

TEST_CASE("a smooth disc that is pushed along a smooth block is not said to rest where it has slid to in one phase") {
  for (const std::string pair : {"'block', 'disc'", "'disc', 'block'"}) {
    CAPTURE(pair);
    const Summary pushed = scenes::run_text(disc_on_block(0.03, pair));
    CHECK(pushed.status != RunStatus::equilibrium);
    const Summary rests = scenes::run_text(disc_on_block(0, pair));
    CHECK(rests.status == RunStatus::equilibrium);
  }
  CHECK_THAT(scenes::run_text(disc_on_block(0.03, "'block', 'disc'")).reason,
             Catch::Contains("nothing holds 'disc' along x"));
}

TEST_CASE("two bodies that are rough to each other come to rest, though their contact opens and closes on the way") {
  // What closes again bore the shear of its neighbours at once: there was no rest between open and closed.
  const double slope = std::tan(0.4);
  const Summary s = scenes::run_text(fmt::format(
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 2]\ncells = [7, 15]\n"
      "[[body]]\nname = 'lower'\npolygon = [[0, 0], [1, 0], [1, {0}], [0, 0.61]]\nmaterial = 'm'\nplacement = 'gauss'\n"
      "[[body]]\nname = 'upper'\npolygon = [[0, 0.61], [1, {0}], [1, 1.7], [0, 1.7]]\nmaterial = 'm'\n"
      "placement = 'gauss'\n"
      "[material.m]\nlaw = 'linear-elastic'\nE = 100\nnu = 0.3\nrho = 1\n"
      "[[contact]]\nbodies = ['upper', 'lower']\nfriction = 'rough'\n"
      "[[support]]\nface = 'bottom'\nkind = 'roller'\n[[support]]\nface = 'left'\nkind = 'roller'\n"
      "[[support]]\nface = 'right'\nkind = 'roller'\n"
      "[[traction]]\nline = [[0, 1.7], [1, 1.7]]\nvalue = [0, -1]\n"
      "[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-10\nsteps = 10000\n",
      0.61 + slope));
  CAPTURE(s.reason);
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.contacts.at("upper+lower.force_y") == Approx(1).epsilon(1e-8));
}

TEST_CASE("an elastic disc rests with its weight on an elastic block, whichever of the two is named first") {
  const double weight = 1e4 * 30 * 0.09 * std::sin(2 * std::numbers::pi / 60);  // ρ g times the polygon's area
  for (const std::string pair : {"'block', 'disc'", "'disc', 'block'"}) {
    for (const double x : {0.8437, 0.8615}) {
      CAPTURE(pair, x);
      const Summary s = scenes::run_text(disc_on_block(0, pair, x));
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(std::abs(s.contacts.at(pair[1] == 'b' ? "block+disc.force_y" : "disc+block.force_y")) ==
            Approx(weight).epsilon(1e-2));  // of cells that the polygon cuts
    }
  }
}

}  // namespace stillpoint::test

// What nothing holds is at no equilibrium, and neither is what only a corner holds that no border would bear.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace stillpoint::test {
namespace {

Summary run_text(const std::string& text, const std::vector<std::string>& set = {}) {
  return run(load_scene("scene.toml", text, set), {.threads = 1});
}
const std::string rubber = "[material.m]\nlaw = 'neo-hookean'\nE = 1e6\nnu = 0.3\nrho = 1000\n";
const std::string ends = "[damping]\nstrategy = 'auto'\n[stop]\nsteps = 20000\n";

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
         rubber + ends;
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

}  // namespace stillpoint::test

// Material at r = 0 stays there, whatever supports a scene has.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;
using scenes::run_text;

namespace {

// A cylinder under pressure on the middle of its top, held at its base.
constexpr const char* cylinder = R"(
dim = 2
[grid]
min = [0, 0]
max = [1.5, 1.5]
cells = [6, 6]
basis = "quadratic"
[body]
max = [1, 1]
material = "m"
state = "axisymmetric"
points_per_cell = 9
[material.m]
law = "hencky"
E = 100
nu = 0.3
rho = 1
[mass]
kind = "lumped"
[[support]]
face = "bottom"
name = "base"
[[traction]]
line = [[0, 1], [0.5, 1]]
value = [0, -15]
[damping]
strategy = "auto"
[stop]
residual = 1e-9
[[probe]]
name = "axis"
at = [0, 0.5]
fields = ["u.x"]
[[probe]]
name = "top"
at = [0, 1]
fields = ["u.x", "u.y"]
[[probe]]
name = "inside"
at = [0.5, 0.5]
fields = ["u.x", "u.y", "stress.xx"]
)";

std::vector<std::string> with_support(std::vector<std::string> all, const std::string& more) {
  if (!more.empty()) all.push_back(more);
  return all;
}

constexpr const char* roller = "support=[{face='bottom', name='base'}, {face='left', kind='roller', name='axis'}]";

}  // namespace

TEST_CASE("an axisymmetric body does not move off its axis: it needs no support there, on any basis, in phases too") {
  struct Case {
    const char* basis;
    const char* law;
    const char* motion;
    const char* points;
  };
  for (const Case& c : {Case{"linear", "hencky", "0.1", "4"}, Case{"quadratic", "neo-hookean", "0.1", "9"},
                        Case{"cubic", "hencky", "0.1", "9"}, Case{"linear", "linear-elastic", "none", "4"},
                        Case{"quadratic", "hencky", "none", "9"}, Case{"cubic", "linear-elastic", "none", "16"},
                        Case{"hermite", "linear-elastic", "none", "16"}}) {
    CAPTURE(c.basis, c.law, c.motion);
    const std::vector<std::string> overrides = {
        fmt::format("grid.basis={}", c.basis), fmt::format("material.m.law={}", c.law),
        fmt::format("phase.max_motion={}", c.motion), fmt::format("body.points_per_cell={}", c.points)};
    const Summary free = run_text(cylinder, overrides), held = run_text(cylinder, with_support(overrides, roller));
    REQUIRE(free.status == RunStatus::equilibrium);
    REQUIRE(held.status == RunStatus::equilibrium);
    for (const char* place : {"axis", "top"})
      CHECK(std::abs(scenes::probe(free, place, "u.x")) <= 1e-15);  // of a body of size 1
    const auto same = [&](const char* place, const char* field) {
      // The same equations: what an order of sums leaves.
      CHECK(scenes::probe(free, place, field) == Approx(scenes::probe(held, place, field)).epsilon(1e-8));
    };
    same("top", "u.y");
    same("inside", "u.x");
    same("inside", "stress.xx");
    CHECK(free.reactions.size() == 1);  // the axis is nobody's support
  }
}

TEST_CASE("a body with a hole is not held at its axis, however narrow the hole") {
  for (const char* basis : {"linear", "quadratic", "cubic"}) {
    for (const double hole : {0.01, 0.1, 0.24}) {  // cells are 0.25 wide
      CAPTURE(basis, hole);
      const Summary s =
          run_text(cylinder, {fmt::format("grid.basis={}", basis), fmt::format("body.min=[{}, 0]", hole),
                              "body.points_per_cell=16", "material.m.law=linear-elastic", "body.placement=gauss",
                              "traction=[{face='top', value=[0, -15]}]", "support=[{face='bottom', kind='roller'}]",
                              "phase.max_motion=none",
                              fmt::format("probe=[{{name='inner', at=[{}, 0.5], fields=['u.x']}}]", hole + 1e-9)});
      REQUIRE(s.status == RunStatus::equilibrium);
      // Uniaxial stress: u_r = ν σ/E r. Its gradient is what any basis has; held, it would be 0 at the hole.
      CHECK(scenes::probe(s, "inner", "u.x") == Approx(0.3 * 15 / 100 * hole).epsilon(1e-4));
    }
  }
}

TEST_CASE("a blind bore is free, and the body below it is held") {
  // A bore of radius 0.1, less than half a cell, from the top down to y = 0.5.
  std::string text = cylinder;
  const std::string box = "max = [1, 1]\n";
  text.replace(text.find(box), box.size(), "polygon = [[0, 0], [1, 0], [1, 1], [0.1, 1], [0.1, 0.5], [0, 0.5]]\n");
  const Summary s = run_text(
      text, {"material.m.law=linear-elastic", "phase.max_motion=none", "body.points_per_cell=9",
             "traction=[{line=[[0.1, 1], [1, 1]], value=[0, -15]}]",
             "probe=[{name='axis', at=[0, 0.25], fields=['u.x']}, {name='bore', at=[0.1, 0.9], fields=['u.x']}]"});
  REQUIRE(s.status == RunStatus::equilibrium);
  CHECK(std::abs(scenes::probe(s, "axis", "u.x")) <= 1e-15);
  CHECK(std::abs(scenes::probe(s, "bore", "u.x")) >= 1e-4);  // of 0.005 by ν σ/E r
}

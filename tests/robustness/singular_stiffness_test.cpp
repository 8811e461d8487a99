// Cells with too few points have motions that nothing resists. Where the load does not drive them no way to equilibrium
// puts any of them into its answer.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Contains;
using scenes::run_text;

namespace {

constexpr const char* beam = R"(
dim = 3
[grid]
min = [0, 0, 0]
max = [4, 1, 1]
cells = [4, 2, 2]
basis = "linear"
[body]
material = "m"
points_per_cell = 1
[material.m]
law = "linear-elastic"
E = 1e3
nu = 0.3
rho = 1
[mass]
kind = "lumped"
[[support]]
face = "left"
[body_force]
value = [0, -1, 0]
[stop]
residual = 1e-8
[[probe]]
name = "c"
at = [4, 0.5, 0.5]
fields = ["u.y"]
)";

const std::vector<std::string> ways_to_rest = {"solve.method=newton", "solve.method=newton-cg", "solve.method=cg",
                                               "solve.method=lbfgs", "damping.strategy=auto"};

}  // namespace

TEST_CASE("one point a cell in space: every way leads to the answer without hourglass motions, and a note tells") {
  const std::vector<std::vector<std::string>> variants = {
      {},
      {"grid.cells=[6, 2, 3]", "material.m.nu=0.45"},
      {"body_force.value=[0.5, 2, -0.05]", "grid.cells=[5, 3, 2]"},
      {"body.points_per_cell=[2, 1, 1]"},
  };
  for (const auto& variant : variants) {
    double reference = 0;
    for (const std::string& way : ways_to_rest) {
      auto overrides = variant;
      overrides.push_back(way);
      CAPTURE(overrides);
      const Summary s = run_text(beam, overrides);
      REQUIRE(s.status == RunStatus::equilibrium);
      const double u = scenes::probe(s, "c", "u.y");
      if (reference == 0) reference = u;
      CHECK(u == Approx(reference).epsilon(1e-4));  // the residual's 1e-8 times the beam's condition
      const bool is_told = std::ranges::any_of(
          s.notes, [](const std::string& note) { return note.find("hourglass") != std::string::npos; });
      CHECK(is_told == (variant.empty() || variant[0].find("points_per_cell") == std::string::npos));
    }
    if (variant.empty()) CHECK(reference == Approx(-0.5328).epsilon(1e-3));
  }
}

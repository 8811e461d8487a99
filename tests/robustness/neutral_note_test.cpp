// That an equilibrium is neutral is said of a body that nothing holds, and of none that is held.
#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;
using scenes::run_text;

namespace {

// A cantilever that bends across cells in many phases: points come to lie next to the edges of cells, whose other
// functions they hardly reach.
constexpr const char* soft_cantilever = R"(
dim = 2
[grid]
min = [0, -1]
max = [5, 2]
cells = [10, 6]
basis = "quadratic"
[[body]]
min = [0, 0]
max = [4, 1]
material = "m"
state = "plane-strain"
points_per_cell = 9
[material.m]
law = "neo-hookean"
E = 100
nu = 0.2
rho = 1
[mass]
kind = "lumped"
[[support]]
face = "left"
[body_force]
value = [0.090226, -0.126919]
[damping]
strategy = "auto"
[stop]
residual = 1e-6
[[probe]]
name = "p"
at = [3.8, 0.5]
fields = ["u.x", "u.y"]
[phase]
max_motion = 0.1
)";

bool says_neutral(const Summary& s) {
  return std::ranges::any_of(s.notes,
                             [](const std::string& note) { return note.find("neutral") != std::string::npos; });
}

}  // namespace

TEST_CASE("functions that hardly reach a body that is held make no neutral equilibrium of its own") {
  const std::vector<std::vector<std::string>> variants = {
      {},
      {"grid.basis=cubic"},
      {"grid.basis=cubic", "material.m.law=hencky", "body_force.value=[0, -0.15]"},
      {"grid.cells=[20, 12]", "body_force.value=[0.05, -0.13]"},
      {"grid.basis=linear", "body_force.value=[0, 0.14]"},
      {"material.m.nu=0.4", "body_force.value=[-0.05, -0.1]", "damping.strategy=kinetic"},
  };
  for (const auto& variant : variants) {
    CAPTURE(variant);
    const Summary s = run_text(soft_cantilever, variant);
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK_FALSE(says_neutral(s));
    CHECK((s.stability == "stable" || s.stability.empty()));  // empty: too many such functions to tell
  }
}

TEST_CASE("a body in phases that nothing holds is in neutral equilibrium, whatever hardly reaches it") {
  for (const char* basis : {"linear", "quadratic", "cubic"}) {
    CAPTURE(basis);
    const Summary s =
        run_text(soft_cantilever,
                 {std::string("grid.basis=") + basis, "support=[]", "body[0].min=[1, 0]", "body_force.value=[0, 0]",
                  "traction=[{line=[[1, 0], [1, 1]], value=[-20, 0]}, {line=[[4, 0], [4, 1]], "
                  "value=[20, 0]}]"});
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(says_neutral(s));
  }
}

// What a support holds, by the name of an axis.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Contains;

namespace {

Scene block(const std::string& supports, const std::string& state = "plane-strain",
            const char* weight = "body_force.value=[0, '-g']") {
  return scenes::load(
      "column", {"grid.cells=[2, 4]", "body.state=" + state, "support=" + supports, "stop.residual=1e-9", weight});
}

}  // namespace

TEST_CASE("a component is the number or the name of an axis, r and z if there is one of symmetry") {
  const auto held = [](const std::string& component, const std::string& state) {
    return block("[{face='bottom'}, {at=[0, 10], component=" + component + "}]", state).supports[1].component;
  };
  CHECK(held("'x'", "plane-strain") == 0);
  CHECK(held("'y'", "plane-strain") == 1);
  CHECK(held("1", "plane-strain") == 1);
  CHECK(held("'r'", "axisymmetric") == 0);
  CHECK(held("'z'", "axisymmetric") == 1);
  CHECK(held("'y'", "axisymmetric") == 1);
  CHECK(held("0", "axisymmetric") == 0);
  CHECK_THROWS_WITH(held("'z'", "plane-strain"), Contains("axes of an axisymmetric scene; expected x or y"));
}

TEST_CASE("a face whose normal component is named is a roller") {
  const auto settled = [](const char* bottom) {
    const Summary s = run(block(std::string("[") + bottom + ", {at=[0, 0], component='x'}]"));
    REQUIRE(s.status == RunStatus::equilibrium);
    return scenes::probe(s, "top", "u.y");
  };
  CHECK(settled("{face='bottom', component='y'}") == settled("{face='bottom', kind='roller'}"));
  CHECK(std::abs(settled("{face='bottom', component='y'}")) > 1e-3);
}

TEST_CASE("a face can be moved along itself: simple shear is exact") {
  // u_x = γ y, u_y = 0 with the sides free to take it: τ = G γ on every face.
  const Scene scene = block(
      "[{face='bottom'}, {face='top', component='x', u=0.01}, {face='top', component='y'},"
      "{face='left', component='y'}, {face='right', component='y'}]",
      "plane-strain", "body_force.value=[0, 0]");
  Simulation simulation(scene);
  REQUIRE(simulation.run() == RunStatus::equilibrium);
  const double G = 20e6 / (2 * 1.3), gamma = 0.01 / 10;
  const ConstVec stress = simulation.field("stress");
  for (std::size_t p = 0; p < simulation.points(); ++p) {
    CHECK(stress[4 * p + 3] == Approx(G * gamma).epsilon(1e-6));
    CHECK(std::abs(stress[4 * p + 1]) < 1e-6 * G * gamma);
  }
}

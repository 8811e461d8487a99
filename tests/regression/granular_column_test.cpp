// A round column of sand that collapses [Lube, Huppert, Sparks and Hallworth 2004, J. Fluid Mech. 508:175].
#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

TEST_CASE("a round column of sand runs out by 1.24 of its radius within 30 %") {
  Simulation simulation(scenes::load("granular_column", {"output.stages=[]"}));
  REQUIRE(simulation.run() == RunStatus::end_time);
  const ConstVec x = simulation.field("position");
  const std::vector<double> volume =
      simulation.parts().phase.fields().point_data().masses;  // undeformed: the density is 1
  // The heap's depth in rings, a cell wide; it ends where it is a grain deep.
  constexpr double width = 0.1, grain = 0.02;
  std::vector<double> depth(36);
  for (std::size_t p = 0; p < simulation.points(); ++p) {
    const auto ring = static_cast<std::size_t>(std::hypot(x[3 * p], x[3 * p + 2]) / width);
    const double inner = width * static_cast<double>(ring), outer = inner + width;
    REQUIRE(ring < depth.size());
    depth[ring] += volume[p] / (std::numbers::pi / 4 * (outer * outer - inner * inner));
  }
  std::size_t rings = depth.size();
  while (rings > 0 && depth[rings - 1] < grain) --rings;
  const double run_out = width * static_cast<double>(rings) - 1;
  CAPTURE(run_out);
  CHECK(run_out > 0.7 * 1.24);
  CHECK(run_out < 1.1 * 1.24);
}

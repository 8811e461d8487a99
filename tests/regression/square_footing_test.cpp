// The limit load of a square footing on clay, in space: problems/square_footing.toml.
#include <cmath>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

/// N_c at the end and after 0.8 of the way.
struct BearingFactor {
  double last, before;
};
BearingFactor bearing_factor(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"constants.T=0.15", "output.every=T/10"});
  Simulation simulation(scenes::load("square_footing", overrides), {.records = false});
  const auto factor = [&] { return -simulation.summary().reactions.at("footing")[1] / 10e3; };
  simulation.run_until(0.12);
  const double before = factor();
  simulation.run();
  REQUIRE(simulation.status() == RunStatus::end_time);
  return {factor(), before};
}

}  // namespace

TEST_CASE("a square footing on clay comes to a limit load, on cells that share their change of volume") {
  const std::string coarse = "grid.cells=[7, 5, 7]";
  const BearingFactor on_coarse = bearing_factor({coarse}), on_fine = bearing_factor({});
  CAPTURE(on_coarse.last, on_fine.last);
  CHECK(on_coarse.last == Approx(on_coarse.before).epsilon(0.003));
  CHECK(on_fine.last == Approx(on_fine.before).epsilon(0.003));
  // 7.66, 6.56 and 6.04 on cells of b/2, b/4 and b/8 fall as h, towards 5.5
  CHECK(on_coarse.last - on_fine.last == Approx(1.1).epsilon(0.1));
  CHECK(2 * on_fine.last - on_coarse.last == Approx(5.5).epsilon(0.03));
  // The strength is that of the cone in plane strain, or 2/√3 of it in compression.
  CHECK(bearing_factor({coarse, "material.clay.cone=compression"}).last / on_coarse.last ==
        Approx(2 / std::sqrt(3.0)).epsilon(0.01));
  CHECK(bearing_factor({coarse, "phase.dilatation=points"}).last > 1.3 * on_coarse.last);
}

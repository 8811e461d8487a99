// Where auto takes a multigrid mass by itself.
#include "simulation/multigrid_choice.hpp"

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

TEST_CASE("a multigrid mass pays in the plane from some hundred cells a side on, in space from a hundred and fifty") {
  const auto pays = [](const char* scene, const char* cells, double unknowns) {
    return multigrid_pays(scenes::load(scene, {"damping.strategy=auto", "stop.distance=0", "grid.basis=linear",
                                               "body.points_per_cell=1", cells}),
                          unknowns, true);
  };
  CHECK_FALSE(pays("incompressible", "grid.cells=[30, 24]", 1.5e3));
  CHECK(pays("incompressible", "grid.cells=[480, 384]", 3e5) == STILLPOINT_HAS_MULTIGRID);
  CHECK_FALSE(pays("oedometer", "grid.cells=[100, 50, 100]", 1.5e6));  // 60 s of processor time for 11
  CHECK(pays("oedometer", "grid.cells=[160, 160, 160]", 1.2e7) == STILLPOINT_HAS_MULTIGRID);
}

// What a program that was built without PETSc says where a scene asks for it.
#include <catch2/catch.hpp>

#include "linalg/multigrid.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

TEST_CASE("a program without PETSc refuses mass.kind = \"multigrid\" with the package to install, at the key") {
  if (multigrid_is_missing().empty()) return;
  CHECK_THROWS_WITH(Simulation(scenes::load("incompressible", {"mass.kind=multigrid", "damping.strategy=auto"})),
                    Contains("mass.kind") && Contains("libpetsc-real-dev"));
}

TEST_CASE("a program without PETSc brings a large linear body to rest by auto with a lumped mass") {
  if (multigrid_is_missing().empty()) return;
  Simulation simulation(
      scenes::load("incompressible", {"constants.nu=0.3", "grid.basis=linear", "damping.strategy=auto",
                                      "grid.cells=[130,130]", "stop.residual=1e-4"}));
  simulation.run();
  CHECK(simulation.status() == RunStatus::equilibrium);
}

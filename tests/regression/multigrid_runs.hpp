// What the tests of multigrid share: a block of so many cells, and runs that end in equilibrium.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "linalg/multigrid.hpp"
#include "scenes.hpp"

namespace stillpoint::test {

inline std::vector<std::string> block(int cells, std::vector<std::string> others = {}) {
  const std::string n = std::to_string(cells);
  others.insert(others.begin(), {"constants.nu=0.3", "grid.basis=linear", "grid.cells=[" + n + "," + n + "]",
                                 "stop.residual=1e-6", "mass.kind=multigrid"});
  return others;
}

inline Simulation run(const std::string& problem, const std::vector<std::string>& set) {
  Simulation simulation(scenes::load(problem, set));
  simulation.run();
  CAPTURE(simulation.reason());
  CHECK(simulation.status() == RunStatus::equilibrium);
  return simulation;
}

}  // namespace stillpoint::test

#define REQUIRE_MULTIGRID() \
  if (!multigrid_is_missing().empty()) return

// Lamé's sphere, whose surfaces cut the cells of the grid.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

ExactError errors(int cells, std::vector<std::string> set = {}) {
  set.insert(set.begin(), fmt::format("grid.cells=[{0}, {0}, {0}]", cells));
  const Summary summary = run(scenes::load("thick_sphere", set));
  REQUIRE(summary.status == RunStatus::equilibrium);
  return summary.error.value();
}

}  // namespace

TEST_CASE("a thick sphere's u is within 1 % on 8 cells across its wall, and converges with the order of linear cells") {
  const ExactError coarse = errors(8), fine = errors(16);
  CAPTURE(coarse.u_rel_l2, fine.u_rel_l2, *coarse.stress_rel_l2, *fine.stress_rel_l2);
  CHECK(fine.u_rel_l2 < 0.01);
  CHECK(std::log2(coarse.u_rel_l2 / fine.u_rel_l2) > 1.8);
  CHECK(std::log2(*coarse.stress_rel_l2 / *fine.stress_rel_l2) > 0.8);
}

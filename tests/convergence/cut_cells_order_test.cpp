// Bodies whose borders cut the cells askew: observed orders, and answers that fitted volumes bring nearer.
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

double error_on(int cells, const std::string& basis, const std::string& placement, const std::string& volumes) {
  const Summary summary = run(
      scenes::load("ladder/rotated_square", {fmt::format("grid.cells=[{}, {}]", cells, cells), "grid.basis=" + basis,
                                             "body.placement=" + placement, "body.volumes=" + volumes}));
  REQUIRE(summary.status == RunStatus::equilibrium);
  return summary.error->u_rel_l2;
}

double observed_order(const std::string& basis, const std::string& placement, const std::string& volumes) {
  const double coarse = error_on(28, basis, placement, volumes), fine = error_on(56, basis, placement, volumes);
  CAPTURE(coarse, fine);
  return std::log2(coarse / fine);
}

double middle_of_cooks_membrane(const std::string& placement, const std::string& volumes, int points, int cells) {
  const Summary summary = run(scenes::load("ladder/cook", {fmt::format("grid.cells=[{}, {}]", 4 * cells, 5 * cells),
                                                           fmt::format("body.points_per_cell={}", points),
                                                           "body.placement=" + placement, "body.volumes=" + volumes}));
  REQUIRE(summary.status == RunStatus::equilibrium);
  const auto& [field, value] = summary.probes.at("middle").at(1);
  REQUIRE(field == "u.y");
  return value;
}

}  // namespace

TEST_CASE("in a square askew on the grid u converges with order 2 and 3 by Gauss points of cut cells") {
  CHECK(observed_order("linear", "gauss", "consistent") == Approx(2).margin(0.3));
  CHECK(observed_order("quadratic", "gauss", "consistent") == Approx(3).margin(0.3));
  // Cubic functions are held back by cells that take a neighbour's functions, to between 2 and 3.
  CHECK(observed_order("cubic", "gauss", "consistent") > 2.2);
}

TEST_CASE("volumes that share the area of cut cells equally hold quadratic functions at order 2") {
  CHECK(observed_order("quadratic", "uniform", "equal") < 2.3);
  for (const std::string placement : {"uniform", "gauss"}) {
    CAPTURE(placement);
    CHECK(error_on(56, "quadratic", placement, "consistent") < error_on(56, "quadratic", placement, "equal"));
  }
}

TEST_CASE("Cook's membrane by quadratic cells is nearer to its answer with fitted volumes, nearest with Gauss points") {
  constexpr double exact = 21.945;  // finite elements of order 5 and 6, in the scene's header
  for (const int points : {9, 16}) {
    for (const int cells : {4, 8}) {
      CAPTURE(points, cells);
      const double equal = std::abs(middle_of_cooks_membrane("uniform", "equal", points, cells) - exact);
      const double fitted = std::abs(middle_of_cooks_membrane("uniform", "consistent", points, cells) - exact);
      const double gauss = std::abs(middle_of_cooks_membrane("gauss", "consistent", points, cells) - exact);
      CHECK(fitted < equal);
      CHECK(gauss < fitted);
    }
  }
}

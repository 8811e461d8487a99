// Bodies whose borders cut the cells askew: observed orders, and answers that fitted volumes bring nearer.
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

ExactError errors(const std::string& scene, int cells, const std::vector<std::string>& set) {
  std::vector<std::string> overrides = {fmt::format("grid.cells=[{}, {}]", cells, cells)};
  overrides.insert(overrides.end(), set.begin(), set.end());
  const Summary summary = run(scenes::load("ladder/" + scene, overrides));
  REQUIRE(summary.status == RunStatus::equilibrium);
  return summary.error.value();
}

double error_on(int cells, const std::string& basis, const std::string& placement, const std::string& volumes) {
  return errors("rotated_square", cells,
                {"grid.basis=" + basis, "body.placement=" + placement, "body.volumes=" + volumes})
      .u_rel_l2;
}

double observed_order(const std::string& basis, const std::string& placement, const std::string& volumes) {
  const double coarse = error_on(28, basis, placement, volumes), fine = error_on(56, basis, placement, volumes);
  CAPTURE(coarse, fine);
  return std::log2(coarse / fine);
}

}  // namespace

// With 25 points a cut cell integrates degree 5, with 16 degree 4, which is enough for quadratic functions alone.
TEST_CASE("in a square askew on the grid u converges with the order of the basis by Gauss points of cut cells") {
  for (const auto& [basis, points, order] : {std::tuple{"linear", 16, 2}, {"quadratic", 16, 3}, {"cubic", 25, 4}}) {
    CAPTURE(basis);
    const std::vector<std::string> set = {fmt::format("grid.basis={}", basis),
                                          fmt::format("body.points_per_cell={}", points)};
    const double coarse = errors("rotated_square", 28, set).u_rel_l2, fine = errors("rotated_square", 56, set).u_rel_l2;
    CHECK(std::log2(coarse / fine) > order - 0.2);
  }
}

TEST_CASE("around a hole that cuts the cells u and the stress converge with the order of the basis") {
  for (const auto& [basis, points, order] : {std::tuple{"linear", 9, 2}, {"quadratic", 16, 3}, {"cubic", 36, 4}}) {
    CAPTURE(basis);
    const std::vector<std::string> set = {fmt::format("grid.basis={}", basis),
                                          fmt::format("body.points_per_cell={}", points)};
    const ExactError coarse = errors("kirsch", 16, set), fine = errors("kirsch", 32, set);
    CHECK(std::log2(coarse.u_rel_l2 / fine.u_rel_l2) > order - 0.2);
    CHECK(std::log2(coarse.stress_rel_l2.value() / fine.stress_rel_l2.value()) > order - 1.2);
  }
}

TEST_CASE("volumes that share the area of cut cells equally hold quadratic functions at order 2") {
  CHECK(observed_order("quadratic", "uniform", "equal") < 2.3);
  for (const std::string placement : {"uniform", "gauss"}) {
    CAPTURE(placement);
    CHECK(error_on(56, "quadratic", placement, "consistent") < error_on(56, "quadratic", placement, "equal"));
  }
}

TEST_CASE("around a hole the stress of quadratic cells is nearer with fitted volumes, nearest with Gauss points") {
  for (const int points : {9, 16}) {
    for (const int cells : {16, 32}) {
      CAPTURE(points, cells);
      const auto error = [&, along = fmt::format("body.points_per_cell={}", points)](const std::string& placement,
                                                                                     const std::string& volumes) {
        return errors("kirsch", cells, {along, "body.placement=" + placement, "body.volumes=" + volumes})
            .stress_rel_l2.value();
      };
      const double fitted = error("uniform", "consistent");
      CHECK(fitted < error("uniform", "equal"));
      CHECK(error("gauss", "consistent") < fitted);
    }
  }
}

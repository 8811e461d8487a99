// Convergence in h where cells are unequal: each piece of an axis is refined, and the orders are those of equal cells.
#include <stillpoint/converge.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

double order_of(const ConvergenceStudy& study, const std::string& name) {
  const auto found = std::ranges::find(study.quantities, name, &StudiedQuantity::name);
  REQUIRE(found != study.quantities.end());
  REQUIRE(found->order);
  return found->order->order;
}

}  // namespace

TEST_CASE("in cells that grow and jump, u of Lame's cylinder converges with order 2 and 3, its stress with one less") {
  struct Case {
    std::string basis, points;
    double order;
  };
  for (const auto& [basis, points, order] : {Case{"linear", "4", 2}, Case{"quadratic", "9", 3}}) {
    CAPTURE(basis);
    const ConvergenceStudy study =
        converge(scenes::load("cylinder",
                              {"grid.x=[[1, 1.25, 4, 2], [1.25, 2, 3, 1.5]]", "grid.y=[[0, 0.15, 2], [0.15, 0.25, 1]]",
                               "grid.basis=" + basis, "body.points_per_cell=" + points, "solve.method=newton",
                               "stop.residual=1e-12", "stop.distance=0",
                               "exact={solution='lame-cylinder', inner_radius=1, outer_radius=2, inner_pressure='p'}"}),
                 {.levels = 4, .finds_dominant = false});
    CHECK(order_of(study, "u_l2") == Approx(order).margin(0.15));
    CHECK(order_of(study, "stress_l2") == Approx(order - 1).margin(0.15));
    for (std::size_t k = 1; k < study.levels.size(); ++k) CHECK(study.levels[k].h == study.levels[k - 1].h / 2);
  }
}

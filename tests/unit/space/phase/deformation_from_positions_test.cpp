// The deformation of elastic points when a phase begins, from where they are.
#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using Catch::Contains;
using stillpoint::test::free_block;
using stillpoint::test::free_soil;

namespace {

Simulation advanced_to(const Scene& scene, double t_end, int threads = 1) {
  Simulation simulation(scene, {.threads = threads, .records = false, .stops = false});
  REQUIRE(simulation.run_until(t_end) == RunStatus::running);
  return simulation;
}

std::vector<double> stress(const Simulation& simulation) {
  std::vector<double> values(4 * simulation.points());
  simulation.parts().phase.fields().point_stress(simulation.t(), simulation.u(), values);
  return values;
}

}  // namespace

TEST_CASE("bodies that come to lie against each other are not strained by the way that one has gone") {
  // From 1.5 cells apart until the same functions reach both: a fit over both would see a jump of a cell.
  const auto blocks = [](const std::string& deformation) {
    return free_block({"grid={min=[0, 0], max=[4, 1], cells=[16, 4], basis='quadratic'}",
                       "body=[{min=[0.5, 0.25], max=[1.25, 0.75], material='stuff'}, "
                       "{min=[1.625, 0.25], max=[2.375, 0.75], material='stuff'}]",
                       "initial.v=['(x < 1.4)', 0]", "integrator.step_fraction=0.2",
                       "phase.deformation=" + deformation});
  };
  for (const double t : {0.2, 0.3}) {
    const Simulation fitted = advanced_to(blocks("positions"), t), multiplied = advanced_to(blocks("accumulated"), t);
    REQUIRE(fitted.phases() > 5);
    const double of_fitted = largest_magnitude(stress(fitted)), expected = largest_magnitude(stress(multiplied));
    CAPTURE(t, of_fitted, expected);
    CHECK(of_fitted < 1.3 * expected);
  }
}

TEST_CASE("the fit of the deformation gives the same bits for any number of threads") {
  const Scene scene = free_block({"grid={min=[0, 0], max=[2.25, 1], cells=[108, 48], basis='quadratic'}",
                                  "initial.v=['y', '-x']", "integrator.step_fraction=0.5"});
  const Simulation one = advanced_to(scene, 0.02), three = advanced_to(scene, 0.02, 3);
  REQUIRE(one.phases() > 5);
  CHECK(stress(one) == stress(three));
}

TEST_CASE(
    "phase.deformation is refused where no point's deformation is carried on, and accumulated at points of a linear "
    "basis") {
  CHECK_THROWS_WITH(free_block({"phase={max_motion='none', deformation='positions'}"}),
                    Contains("phase.deformation") && Contains("goes with phases only"));
  CHECK_THROWS_WITH(free_soil({"phase.deformation=positions"}),
                    Contains("phase.deformation") && Contains("laws without history"));
  CHECK(free_block().phase.deformation == DeformationRule::accumulated);
  CHECK(free_block({"phase.quadrature=domains"}).phase.deformation == DeformationRule::positions);
  CHECK(free_block({"grid.basis=quadratic"}).phase.deformation == DeformationRule::positions);
  CHECK(free_block({"phase.deformation=positions"}).phase.deformation == DeformationRule::positions);
}

TEST_CASE("a run in phases says how much of the stresses its grid does not feel, a single phase does not") {
  const std::vector<std::string> spread = {"initial.v=['x', '-y']", "grid.basis=quadratic"};
  const Summary several = run(free_block(spread), {.threads = 1});
  REQUIRE(several.null_space_stress);
  CHECK(*several.null_space_stress >= 0);
  CHECK(*several.null_space_stress < 0.1);
  CHECK_FALSE(run(free_block({"phase.max_motion=none"}), {.threads = 1}).null_space_stress);
}

// What is made for a problem, before anything of it is made.
#include "plan/plan.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

Plan plan_of(const char* scene, std::vector<std::string> set) {
  return make_plan(scenes::load(scene, set), {.bytes = std::numeric_limits<double>::infinity(), .set_by = "nothing"});
}

bool has_part(const Plan& plan, const std::string& what) {
  return std::ranges::any_of(plan.memory, [&](const MemoryPart& part) { return part.what == what; });
}

}  // namespace

TEST_CASE("a multigrid mass pays in the plane from some hundred cells a side on, in space from a hundred and fifty") {
  const auto pays = [](const char* scene, const char* cells, double unknowns) {
    const Scene large = scenes::load(
        scene, {"damping.strategy=auto", "stop.distance=0", "grid.basis=linear", "body.points_per_cell=1", cells});
    Plan plan = make_plan(large);
    revise(large, {.unknowns = unknowns, .linear = true}, plan);
    return plan.multigrid;
  };
  CHECK_FALSE(pays("incompressible", "grid.cells=[30, 24]", 1.5e3));
  CHECK(pays("incompressible", "grid.cells=[480, 384]", 3e5) == STILLPOINT_HAS_MULTIGRID);
  CHECK_FALSE(pays("oedometer", "grid.cells=[100, 50, 100]", 1.5e6));  // 60 s of processor time for 11
  CHECK(pays("oedometer", "grid.cells=[160, 160, 160]", 1.2e7) == STILLPOINT_HAS_MULTIGRID);
}

TEST_CASE("the table of memory has what the decisions make, and nothing else") {
  const Plan viscous = plan_of("inclusion", {});
  CHECK(viscous.makes_factor());
  CHECK(has_part(viscous, "factor of the stiffness"));
  CHECK_FALSE(has_part(viscous, "the same with another mass"));
  const Plan large = plan_of("oedometer", {"grid.cells=[40, 40, 40]", "damping.strategy=kinetic"});
  CHECK_FALSE(large.omega_1.any());  // a factor would take longer than the way to rest
  CHECK_FALSE(has_part(large, "factor of the stiffness"));
  const Plan chosen = plan_of("inclusion", {"damping.strategy=auto"});
  CHECK(chosen.tries_scaled_mass);
  CHECK(has_part(chosen, "the same with another mass"));
  double all = 0;
  for (const MemoryPart& part : chosen.memory) all += part.bytes;
  CHECK(chosen.bytes() == Approx(all));
}

TEST_CASE("a distance is planned by a factor as long as the machine has room for it, and else by the steps or not") {
  const std::vector<std::string> set = {"grid.cells=[28, 28, 28]", "mass.kind=lumped", "stop.distance=1e-6",
                                        "damping.strategy=auto", "material.soil.law=neo-hookean"};
  const Scene scene = scenes::load("oedometer", set);
  CHECK(make_plan(scene, {.bytes = 1e12, .set_by = "a large machine"}).omega_1.distance);
  CHECK_FALSE(make_plan(scene, {.bytes = 7e8, .set_by = "a small machine"}).omega_1.any());
}

TEST_CASE("a plan is corrected by what shows once the model is made") {
  const Scene scene = scenes::load("inclusion", {"damping.strategy=auto", "mass.kind=multigrid"});
  Plan plan = make_plan(scene);
  REQUIRE(plan.multigrid);
  CHECK(plan.steps_tell_omega_1);
  Estimates found = plan.estimates;
  found.multigrid_serves = found.linear = false;
  revise(scene, found, plan);
  CHECK_FALSE(plan.multigrid);
  CHECK_FALSE(plan.steps_tell_omega_1);
}

TEST_CASE("a plan that the machine has no room for is refused with the key that sets its largest part") {
  Plan plan = plan_of("inclusion", {});
  CHECK_NOTHROW(require_memory(plan));
  plan.room = {.bytes = 1, .set_by = "a test"};
  CHECK_THROWS_WITH(require_memory(plan), Catch::Contains("the run needs about ") &&
                                              Catch::Contains("a test leaves 1e-09 GB; expected fewer cells"));
}

// The error bound of bodies too large for a factor of K.
#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "distance_to_rest.hpp"
#include "largest.hpp"
#include "plan/plan.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "simulation/setup/model.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("a large body learns omega_1 from the steps of auto or cg, and its distance bounds the error from then on") {
  const char* method = GENERATE("relaxation", "cg");
  struct Load {
    const char* description;
    std::vector<std::string> overrides;
  };
  const std::vector<Load> loads = {
      {"its weight", {}},
      {"a pressure on a tenth of its top", {"traction=[{line=[[0.45, 1.0], [0.55, 1.0]], value=[0.0, -0.01]}]"}},
      {"a load that drives short waves", {"body_force.value=[0.0, \"0.01*sin(60*x)*sin(50*y)\"]"}}};
  for (const auto& [description, overrides] : loads) {
    std::vector<std::string> all = {"constants.nu=0.3", "grid.cells=[130, 104]", "grid.basis=linear",
                                    "damping.strategy=auto"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    Scene scene = scenes::load("incompressible", all);
    const Values rest = equilibrium_of(scene);
    scene.solve.method = method;  // which a file with [damping] may not say
    Simulation simulation(scene, {.records = false});
    REQUIRE_FALSE(simulation.parts().model.omega_1);  // it has more than 20 000 unknowns
    const Mass& M = simulation.parts().model.phase->mass();
    const double scale = mass_norm(M, rest);
    Smallest least;
    long unknown = 0;
    while (simulation.step() == RunStatus::running) {
      const auto distance = simulation.distance();
      if (!distance) {
        ++unknown;
        continue;
      }
      const double error = relative_difference(M, simulation.u(), rest);
      if (error > 1e-9) least.take(*distance * mass_norm(M, simulation.u()) / scale / error);
    }
    INFO(method << ", " << description << ": " << least.value() << ", " << unknown << " of " << simulation.steps()
                << " steps without a distance");
    CHECK(simulation.status() == RunStatus::equilibrium);
    CHECK(least.value() >= 1);
    CHECK(unknown < 3 * simulation.steps() / 4);  // it wants to be sure
    REQUIRE(simulation.distance());
    CHECK(*simulation.distance() <= 1e-3);
  }
}

TEST_CASE("a large body in space goes without a factor and says that it has no error bound, unless that is asked for") {
  const auto scene_with = [](int cells, const std::vector<std::string>& more) {
    std::vector<std::string> set = {"damping.strategy=kinetic", fmt::format("grid.cells=[{0}, {0}, {0}]", cells)};
    set.insert(set.end(), more.begin(), more.end());
    return scenes::load("oedometer", set);
  };
  const auto has_note = [](const Model& model) {
    return std::ranges::any_of(model.notes, [](const std::string& note) { return note.find("no error bound") < 200; });
  };
  const Model large = make_model(scene_with(26, {}));
  REQUIRE(large.phase->size() > 45'000);
  CHECK_FALSE(large.omega_1);
  CHECK(has_note(large));
  const Model small = make_model(scene_with(8, {}));
  CHECK(small.omega_1);
  CHECK_FALSE(has_note(small));
  CHECK(make_plan(scene_with(26, {"stop.distance=1e-3"})).omega_1.any());
  const Model in_the_plane = make_model(scenes::load("incompressible", {"grid.cells=[200, 160]", "grid.basis=linear"}));
  CHECK(in_the_plane.phase->size() > 50'000);
  CHECK(in_the_plane.omega_1);
}

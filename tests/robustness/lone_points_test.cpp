// Material points that have parted from the rest of the body.
#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace {

// A light point in flight above a heavy bed, with its material's stiffness: no function has much of the inertia that
// its frequency asks for.
Summary flight(const std::string& rho, const std::string& place) {
  const stillpoint::test::TemporaryFolder folder;
  return run(load_scene(folder.write("flight.toml", R"(dim = 2
grid = {min = [0, 0], max = [2, 2], cells = [8, 8], basis = "linear"}
material.bed = {law = "drucker-prager", E = 1e6, nu = 0.3, rho = 1800, phi = 35}
material.grain = {law = "drucker-prager", E = 1e6, nu = 0.3, rho = )" +
                                                        rho + R"(, phi = 35}
mass.kind = "lumped"
phase.max_motion = 0.1
support = [{face = "bottom"}, {face = "left", kind = "roller"}, {face = "right", kind = "roller"}]
body_force.value = [0.0, -9.81]
damping.strategy = "none"
stop = {residual = 0, time = 0.2}
probe = [{name = "grain", point = 65, fields = ["u.y", "v.y"]}]
[[body]]
max = [2, 0.5]
material = "bed"
points_per_cell = 4
[[body]]
min = [1.02, 1.51]
max = [1.23, )" + place + R"(]
material = "grain"
points_per_cell = 1
)")));
}

}  // namespace

TEST_CASE("a point that flies alone falls as gravity has it, however light it is beside its stiffness") {
  for (const std::string rho : {"1800", "300", "30"}) {
    for (const std::string place : {"1.73", "1.55"}) {
      const Summary s = flight(rho, place);
      CAPTURE(rho, place, s.reason);
      CHECK(s.status == RunStatus::end_time);
      CHECK(scenes::probe(s, "grain", "v.y") == Approx(-9.81 * 0.2).epsilon(1e-9));
    }
  }
}

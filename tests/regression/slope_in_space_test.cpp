// Sand between two side walls, in space: problems/slope_in_space.toml.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

/// On cells of 0.3 m, 20 × 10 of them filled and so many from the middle to the side wall.
Summary slope_across(int across, const std::string& friction) {
  const std::string width = std::to_string(0.3 * across);
  const Summary s = run(
      scenes::load("slope_in_space", {"grid.cells=[20, 12, " + std::to_string(across) + "]", "grid.max=[6, 3.6, 'W']",
                                      "constants.W=" + width, "constants.h=0.3", "constants.mu=" + friction}),
      {.threads = 1});
  CHECK(s.status == RunStatus::end_time);
  CHECK(s.mass_error.value() < 1e-12);
  return s;
}

}  // namespace

TEST_CASE("sand between smooth side walls forms the slope of its plane, between rough ones a steeper one") {
  const Summary plane =
      run(scenes::load("slope", {"constants.h=0.3", "grid.cells=[20, 12]", "grid.max=[6, 3.6]"}), {.threads = 1});
  const Summary smooth = slope_across(1, "0"), rough = slope_across(2, "0.4");
  const double angle = plane.slope_angle.value(), in_the_middle = scenes::probe(smooth, "middle", "slope_angle");
  CAPTURE(angle);
  CHECK(in_the_middle == Approx(angle).margin(2));  // runs that differ by rounding differ by 0.4° each, on this grid
  CHECK(scenes::probe(rough, "middle", "slope_angle") > in_the_middle + 3);
  CHECK(scenes::probe(rough, "beside_wall", "slope_angle") > in_the_middle + 3);  // 43° and 35°, by 1° up or down
}

TEST_CASE("in space a slope without a box has no angle, nor in the plane one with a box") {
  using Catch::Contains;
  CHECK_THAT(scenes::refusal("slope_in_space", {"probe=[{name='m', kind='slope_angle'}]"}),
             Contains("probe[0]: the key 'min' is missing: in space a slope is that of the material points in a box"));
  CHECK_THAT(scenes::refusal("slope", {"probe=[{name='m', kind='slope_angle', min=[0, 0], max=[6, 3]}]"}),
             Contains("probe[0].min") && Contains("in space"));
}

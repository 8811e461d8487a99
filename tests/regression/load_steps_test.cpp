// Newton's methods take the load in as many shares as a scene asks for.
#include <stillpoint/compare.hpp>
#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

TEST_CASE("the load in eight shares ends three times as near to that in 64 as in one, where points remember") {
  const auto by = [](int shares) {
    Simulation simulation(scenes::load(
        "footing", {"solve.method=newton", fmt::format("solve.load_steps={}", shares), "stop.residual=1e-8"}));
    simulation.run();
    CHECK(simulation.status() == RunStatus::equilibrium);
    const ConstVec u = simulation.u();
    return std::vector<double>(u.begin(), u.end());
  };
  const std::vector<double> slow = by(64);
  const double one = largest_difference(by(1), slow), eight = largest_difference(by(8), slow);
  CHECK(one > 1e-3 * largest_magnitude(slow));  // the path counts
  CHECK(eight < one / 3);
}

TEST_CASE("shares of the load are refused where they have no part") {
  CHECK_THAT(scenes::refusal("footing", {"solve.method=cg", "solve.load_steps=4"}), Contains("solve.load_steps"));
  CHECK_THAT(scenes::refusal("footing", {"solve.load_steps=4"}), Contains("solve.load_steps"));
  CHECK_THAT(scenes::refusal("footing", {"solve.method=newton", "solve.load_steps=0"}), Contains("solve.load_steps"));
  CHECK(scenes::refusal("footing", {"solve.method=newton-cg", "solve.load_steps=4"}).empty());
}

TEST_CASE("a comparison takes the shares that are asked for, and leaves them to Newton's methods", "[compare]") {
  const auto shared = [](const char* shares) {
    const Comparison c = compare(std::string(STILLPOINT_PROBLEMS) + "/footing.toml", {"solve.method=newton", shares},
                                 {.strategies = {"newton", "cg"}, .repeats = 0, .threads = 1});
    for (const ComparedRun& run : c.runs) {
      CAPTURE(run.reason);
      CHECK(run.status == ComparedStatus::converged);
    }
    return c.runs.at(0).steps;
  };
  CHECK(shared("solve.load_steps=8") > 2 * shared("solve.load_steps=1"));
}

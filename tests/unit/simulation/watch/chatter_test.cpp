// When many phases that lead nowhere are told from those that lead to rest.
#include "simulation/watch/chatter.hpp"

#include <stillpoint/simulation.hpp>

#include <cmath>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "simulation/parts.hpp"

using namespace stillpoint;
using Catch::Contains;

namespace {

constexpr double chatter_cell = 0.25, chatter_way = 0.1;

/// The number of the phase after which a body that stays is said to chatter, of 5000; 0: never.
template <class Residual>
int chatters_after(const Residual& residual_after) {
  const auto phase = make_phase(stillpoint::test::free_block());
  Chatter chatter;
  for (int k = 1; k <= 5000; ++k) {
    if (chatter.take(*phase, chatter_way, residual_after(k), chatter_cell)) return k;
  }
  return 0;
}

}  // namespace

TEST_CASE("a body whose nodes go a hundred cells back and forth while no point moves is said to chatter") {
  const int after = chatters_after([](int) { return 1e-3; });
  CHECK(after > 900);
  CHECK(after < 1100);
}

TEST_CASE("a body does not chatter while its residual comes down") {
  CHECK(chatters_after([](int k) { return std::pow(0.4, k / 1000.0); }) == 0);
}

TEST_CASE("a body does not chatter while its points move on") {
  const Scene scene = stillpoint::test::free_block({"initial.v=[1, 0]", "stop.time=0.4"});
  Simulation simulation(scene, {.records = false, .stops = false});
  Chatter chatter;
  for (int k = 0; k < 200; ++k) {  // 1.6 cells, on a way of 120
    REQUIRE(simulation.run_until(0.002 * (k + 1)) == RunStatus::running);
    CHECK_FALSE(chatter.take(simulation.parts().phase, 0.6, 1, chatter_cell));
  }
}

TEST_CASE("what chatters is said with its way, its residuals and what to change") {
  const auto phase = make_phase(stillpoint::test::free_block());
  Chatter chatter;
  CHECK_FALSE(chatter.take(*phase, 200, 2e-6, chatter_cell));
  const auto said = chatter.take(*phase, 200, 3e-6, chatter_cell);
  REQUIRE(said);
  CHECK_THAT(*said, Contains("200 cells") && Contains("residual 3e-06 after 2e-06") && Contains("phase.max_motion"));
}

// Contact between bodies against exact answers, and what has to be the same whichever way it is found.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

Summary run_ladder(const std::string& name, const std::vector<std::string>& set = {}) {
  return run(scenes::load("ladder/" + name, set), {.threads = 1});  // tests run side by side
}

/// The largest error of the force between the blocks, and of the displacement of the upper one's top.
double error_of_blocks(const Summary& s, double E_2) {
  const double force = std::abs(s.contacts.at("block+base.force_y") - 1);
  const double top = -(0.95 / 100 + 0.95 / E_2);
  return std::max(force, std::abs(scenes::probe(s, "top", "u.y") / top - 1));
}

}  // namespace

TEST_CASE("two blocks of any stiffness bear a uniform stress where they touch off the grid, by every way to rest") {
  for (const double E_2 : {100.0, 1000.0, 1e5}) {
    const std::string stiffness = fmt::format("constants.E2={}", E_2);
    for (const char* strategy :
         {"viscous", "adaptive", "kinetic", "fire", "nesterov", "one-sided", "cundall", "auto"}) {
      if (E_2 > 100 && std::string(strategy) != "auto") continue;  // they take long
      CAPTURE(E_2, strategy);
      const Summary s = run_ladder("stacked_blocks", {stiffness, std::string("damping.strategy=") + strategy});
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(error_of_blocks(s, E_2) < 1e-7);  // a hundred residuals and more
    }
    for (const char* method : {"newton", "newton-cg", "lbfgs"}) {
      CAPTURE(E_2, method);
      const Summary s = run_ladder("stacked_blocks", {stiffness, std::string("solve.method=") + method});
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(error_of_blocks(s, E_2) < 1e-7);
    }
  }
}

}  // namespace stillpoint::test

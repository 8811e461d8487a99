// The equilibrium that a comparison measures with, and the limit of slow loading.
#include "study/reference_solution.hpp"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

/// A column in one phase.
Scene column(std::vector<std::string> set) {
  set.insert(set.begin(), "phase.max_motion=none");
  return scenes::load("column", set);
}

}  // namespace

TEST_CASE("the reference of a comparison is the equilibrium by an independent Newton's method, of any law") {
  for (const std::string law : {"linear-elastic", "neo-hookean"}) {
    CAPTURE(law);
    const Scene scene = column({"material.soil.law=" + law, "constants.E=784800"});  // ρ g H = E/4
    SetUpStore store;
    const Equilibrium found = find_equilibrium(scene, 1, {}, store);
    const std::vector<double> u = statics::solution(*make_phase(scene));
    CHECK(largest_difference(found.state.u(), u) < 1e-9 * largest_magnitude(u));
    CHECK(found.residual <= 1e4 * reference_residual);
    CHECK(found.unique);
    CHECK(found.notes.empty());
    CHECK_THAT(found.method, Contains("Newton's method"));
  }
}

TEST_CASE("the slow ramp of an elastic body ends in its equilibrium, and where soil yields it need not be unique") {
  const Scene elastic = column({"material.soil.law=neo-hookean", "constants.E=784800"});
  SetUpStore store;
  std::vector<std::string> notes;
  const auto ramp = slow_ramp(elastic, store, notes);
  REQUIRE(ramp);
  CHECK(notes.empty());
  CHECK(find_equilibrium(elastic, 1, {}, store).state.error(ramp->u()) < 1e-7);
  const Scene yielding = column({"material.soil={law='drucker-prager', E=2e7, nu=0.2, rho=2000, phi=20, c=1e6}"});
  SetUpStore others;
  CHECK_FALSE(find_equilibrium(yielding, 1, {}, others).unique);
}

TEST_CASE("a body that touches a wall has no slow ramp, and the reason is noted") {
  SetUpStore store;
  std::vector<std::string> notes;
  CHECK_FALSE(slow_ramp(scenes::load("block_on_wall"), store, notes));
  CHECK(notes == std::vector<std::string>{"no slow ramp: Newton's method has no contact"});
}

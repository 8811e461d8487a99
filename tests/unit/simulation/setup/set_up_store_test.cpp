// What simulations of one body share: that it changes nothing, and is made once.
#include "simulation/setup/set_up_store.hpp"

#include <stillpoint/simulation.hpp>

#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;

namespace {

Scene column(const std::string& strategy, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(), {"phase.max_motion=none", "damping.strategy=" + strategy});
  return scenes::load("column", overrides);
}

std::vector<double> after(const Scene& scene, int steps, SetUpStore* store) {
  Simulation simulation(scene, {.threads = 1, .records = false, .stops = false, .store = store});
  for (int k = 0; k < steps; ++k) simulation.step();
  return {simulation.u().begin(), simulation.u().end()};
}

}  // namespace

TEST_CASE("simulations that share their set-up go the way of those that make all of their own, to the bit") {
  SetUpStore store;
  for (const std::string strategy : {"viscous", "kinetic", "auto", "chebyshev", "viscous", "auto", "cundall"}) {
    CAPTURE(strategy);
    CHECK(after(column(strategy), 40, &store) == after(column(strategy), 40, nullptr));
  }
  const Scene adaptive = column("viscous", {"integrator.method=erk:bogacki-shampine-4-2-3", "integrator.rtol=1e-3"});
  for (int again = 0; again < 2; ++again) CHECK(after(adaptive, 40, &store) == after(adaptive, 40, nullptr));
}

TEST_CASE("the second model of a body makes no phase and no frequency, and knows what they took") {
  SetUpStore store;
  const Scene scene = column("viscous");
  Model first = make_model(scene, &store);
  CHECK(first.spared_s == 0);
  store.give_back(first.mass, std::move(first.phase));
  const Model second = make_model(scene, &store);
  double all = 0;
  for (const SetUpPart& part : second.parts) all += part.seconds;
  CHECK(second.spared_s == Approx(all).epsilon(1e-12));
  REQUIRE(second.parts.size() == first.parts.size());
  CHECK(second.parts.front().seconds == first.parts.front().seconds);
  CHECK(second.omega_1 == first.omega_1);
}

TEST_CASE("a phase that remembers or that moves on is not handed on") {
  SetUpStore store;
  const auto is_handed_on = [&](const Scene& scene) {
    store.give_back(scene.mass, store.phase(scene).phase);
    return !store.phase(scene).made_now;
  };
  const std::string yields = "material.soil={law='drucker-prager', E=2e7, nu=0.3, rho=2000, c=1e4, phi=30}";
  CHECK_FALSE(is_handed_on(column("viscous", {yields})));
  CHECK_FALSE(is_handed_on(scenes::load("hard/column_in_phases")));
  CHECK(is_handed_on(column("viscous")));
}

TEST_CASE("masses of another scaling are kept apart") {
  SetUpStore store;
  const Scene plain = column("viscous"), scaled = column("viscous", {"mass.scaling=4"});
  store.give_back(plain.mass, store.phase(plain).phase);
  CHECK(store.phase(scaled).made_now);
  CHECK(make_model(scaled, &store).omega_max == Approx(make_model(plain, &store).omega_max / 2).epsilon(1e-6));
}

TEST_CASE("what could not be made is made by the next who asks") {
  SetUpStore store;
  CHECK_THROWS_AS(store.once("it", []() -> int { throw std::runtime_error("stopped"); }), std::runtime_error);
  CHECK(store.once("it", [] { return 3; }).value == 3);
  CHECK(store.once("it", [] { return 4; }).value == 3);
}

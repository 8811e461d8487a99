#include "study/strength_reduction.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

double tangent(double degrees) { return std::tan(degrees * 0.017453292519943295); }

}  // namespace

TEST_CASE("a factor divides cohesion, the tangent of the friction angle and the cut-off, and caps dilatancy") {
  const MaterialSpec soil = scenes::load("stable_slope", {"material.soil.psi=15", "material.soil.tension=3e3",
                                                          "material.soil.softening=[[0.1, 5e3, 18, 16]]"})
                                .materials.at("soil");
  REQUIRE(has_reducible_strength(soil));
  const MaterialSpec reduced = with_strength_over(soil, 1.5);
  CHECK(reduced.parameters.at("c") == Approx(soil.parameters.at("c") / 1.5).epsilon(1e-14));
  CHECK(reduced.parameters.at("tension") == Approx(2e3).epsilon(1e-14));
  CHECK(tangent(reduced.parameters.at("phi")) == Approx(tangent(20) / 1.5).epsilon(1e-14));
  CHECK(reduced.parameters.at("psi") == reduced.parameters.at("phi"));  // 13.6°
  CHECK(reduced.softening.at(0).c == Approx(5e3 / 1.5).epsilon(1e-14));
  CHECK(tangent(reduced.softening.at(0).phi) == Approx(tangent(18) / 1.5).epsilon(1e-14));
  CHECK(reduced.softening.at(0).psi == reduced.softening.at(0).phi);
  for (const char* same : {"E", "nu", "rho"}) CHECK(reduced.parameters.at(same) == soil.parameters.at(same));
  CHECK(with_strength_over(soil, 1).parameters == soil.parameters);
}

TEST_CASE("strength over 1.2 and then over 1.25 is strength over 1.5") {
  const MaterialSpec soil =
      scenes::load("footing", {"material.ground.phi_residual=10", "material.ground.c_residual=1e3",
                               "material.ground.softening_strain=0.1"})
          .materials.at("ground");
  const MaterialSpec twice = with_strength_over(with_strength_over(soil, 1.2), 1.25),
                     once = with_strength_over(soil, 1.5);
  for (const auto& [name, value] : once.parameters) {
    CAPTURE(name);
    CHECK(twice.parameters.at(name) == Approx(value).epsilon(1e-13));
  }
  CHECK(once.parameters.at("c_residual") == Approx(1e3 / 1.5).epsilon(1e-14));
}

TEST_CASE("an elastic law has no strength that a factor could divide") {
  const MaterialSpec steel = scenes::load("bar", {}).materials.begin()->second;
  CHECK_FALSE(has_reducible_strength(steel));
  CHECK(with_strength_over(steel, 2).parameters == steel.parameters);
}

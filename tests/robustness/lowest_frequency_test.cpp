// ω₁ of slender bodies, whose K is so ill-conditioned that rounding moves the Rayleigh quotient more than its
// tolerance.
#include <stillpoint/spectrum.hpp>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;

TEST_CASE("a cantilever of any thickness has an omega_1, that of ARPACK") {
  for (int k = 0; k <= 25; ++k) {
    const double h = 0.1 + 0.04 * k;
    CAPTURE(h);
    const Model model = make_model(scenes::load("cantilever", {fmt::format("constants.h={}", h)}));
    REQUIRE(model.omega_1);
    const FrequencyEstimate other = omega_1_by_arpack(*model.phase, 0, model.u);
    REQUIRE(other.converged);
    CHECK(*model.omega_1 == Approx(other.omega).epsilon(1e-6));
    // Euler and Bernoulli: 1.8751² √(E I/(ρ A L⁴)) = 1.8751² h/L²; shear and stretch are of the order (h/L)².
    CHECK(*model.omega_1 == Approx(3.51602 * h / 100).epsilon(0.02));
  }
}

#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/material_laws.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

constexpr double E = 210.0, nu = 0.3;
const LameParameters lame = LameParameters::from(E, nu);

// ∂P/∂H by a central difference.
template <class Law>
double slope(const Law& law, double H) {
  constexpr double d = 1e-6;
  return (law.first_piola({H + d})[0] - law.first_piola({H - d})[0]) / (2 * d);
}

}  // namespace

TEST_CASE("a linear elastic bar has Young's modulus, a confined one the oedometric modulus") {
  CHECK(LinearElastic<StressState::uniaxial_stress>(lame).first_piola({0.01})[0] == Approx(E * 0.01).epsilon(1e-14));
  const double confined = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  CHECK(LinearElastic<StressState::uniaxial_strain>(lame).first_piola({0.01})[0] ==
        Approx(confined * 0.01).epsilon(1e-14));
}

TEMPLATE_TEST_CASE("moduli are the derivative of the stress", "", LinearElastic<StressState::uniaxial_stress>,
                   LinearElastic<StressState::uniaxial_strain>, NeoHookean<StressState::uniaxial_stress>,
                   NeoHookean<StressState::uniaxial_strain>) {
  const TestType law(lame);
  for (const double H : {-0.6, -0.1, 0.0, 0.2, 1.5, 4.0})
    CHECK(law.moduli({H})[0] == Approx(slope(law, H)).epsilon(1e-7));
}

TEST_CASE("a neo-Hookean bar agrees with Hooke's law at small strain, to first order in it") {
  const NeoHookean<StressState::uniaxial_stress> law(lame);
  for (const double H : {1e-5, -1e-5}) CHECK(law.first_piola({H})[0] == Approx(E * H).epsilon(3 * std::abs(H)));
  const NeoHookean<StressState::uniaxial_strain> confined(lame);
  CHECK(confined.moduli({0})[0] == Approx(lame.lambda + 2 * lame.mu).epsilon(1e-14));
}

TEST_CASE("the side of a neo-Hookean bar is free of stress at any stretch") {
  // With σ_x from the law, the section's area ratio is w = P/σ; the side's Cauchy stress is [μ (w − 1) + λ ln(F w)]/(F
  // w).
  const NeoHookean<StressState::uniaxial_stress> law(lame);
  for (const double F : {0.05, 0.5, 0.99, 1.3, 3.0, 20.0}) {
    const double w = law.first_piola({F - 1})[0] / law.cauchy({F - 1})[0];
    CHECK(lame.mu * (w - 1) + lame.lambda * std::log(F * w) == Approx(0).margin(1e-11 * E));
  }
}

TEST_CASE("a neo-Hookean stress derives from its energy: no work over a closed cycle") {
  const NeoHookean<StressState::uniaxial_strain> law(lame);
  const auto energy = [](double F) {
    return lame.mu / 2 * (F * F - 1 - 2 * std::log(F)) + lame.lambda / 2 * std::log(F) * std::log(F);
  };
  for (const double F : {0.3, 0.9, 1.7}) {
    constexpr double d = 1e-6;
    CHECK(law.first_piola({F - 1})[0] == Approx((energy(F + d) - energy(F - d)) / (2 * d)).epsilon(1e-7));
  }
}

TEST_CASE("a material turned inside out is not a number, so that the trial is refused") {
  CHECK(std::isnan(NeoHookean<StressState::uniaxial_strain>(lame).first_piola({-1.1})[0]));
  CHECK(std::isnan(NeoHookean<StressState::uniaxial_stress>(lame).first_piola({-1.1})[0]));
}

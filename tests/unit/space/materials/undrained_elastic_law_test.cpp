// Elastic ground from which no water flows, beside Hooke's law, its own skeleton and its own moduli.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/wet_laws.hpp"

using namespace stillpoint;
using checks::lame, checks::WetHencky, checks::WetLinear, checks::WetNeoHookean;
using enum StressState;

TEMPLATE_TEST_CASE("Hooke's law with water that cannot flow is Hooke's law with lambda + K_w/n", "",
                   WET_STATES_OF(WetLinear)) {
  constexpr StressState S = TestType::state;
  const TestType wet(lame);
  const LinearElastic<S> stiffer({lame.lambda + TestType::stiffness, lame.mu});
  for (const auto& H : checks::deformations<S>()) {
    CHECK(checks::relative_distance(wet.first_piola(H), stiffer.first_piola(H)) < 1e-14);
    CHECK(checks::relative_distance(wet.cauchy(H), stiffer.cauchy(H)) < 1e-14);
    CHECK(checks::relative_distance(wet.moduli(H), stiffer.moduli(H)) < 1e-14);
  }
}

TEMPLATE_TEST_CASE("the pore pressure is that of the volume, and the effective stress that of the law", "",
                   WET_STATES_OF(WetNeoHookean), WET_STATES_OF(WetHencky)) {
  constexpr StressState S = TestType::state;
  const TestType wet(lame);
  const auto law = [] {
    if constexpr (std::is_same_v<TestType, WetHencky<S>>)
      return Hencky<S>(lame);
    else
      return NeoHookean<S>(lame);
  }();
  for (const auto& H : checks::deformations<S>()) {
    double J = 1;
    if constexpr (dimensions(S) == 1)
      J += H[0];
    else
      J = determinant(deformation_gradient<S>(H));
    const double p_w = wet.pore_pressure(H);
    CHECK(p_w == Approx(-TestType::stiffness * std::log(J)).epsilon(1e-10).margin(1e-12));  // J rounds
    Stress<S> effective = wet.cauchy(H);
    for (std::size_t a = 0; a < std::min<std::size_t>(3, effective.size()); ++a) effective[a] += p_w;
    CHECK(checks::relative_distance(effective, law.cauchy(H)) < 1e-13);
  }
}

TEMPLATE_TEST_CASE("undrained ground has its rate in a direction from its moduli, at small strains as well", "",
                   WET_STATES_OF(WetNeoHookean), WET_STATES_OF(WetHencky)) {
  constexpr StressState S = TestType::state;
  constexpr int n = gradient_components(S);
  const TestType wet(lame);
  Gradient<S> dH;
  for (int c = 0; c < n; ++c) dH[c] = 0.3 - 0.17 * c;
  for (const auto& H : checks::deformations<S>()) {
    const auto A = wet.moduli(H);
    Gradient<S> along{};
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) along[a] += A[n * a + b] * dH[b];
    CHECK(checks::relative_distance(wet.rate(H, dH), along) < 1e-12);
    if constexpr (requires { wet.is_small(H); }) {
      if (!wet.is_small(H)) continue;
      CHECK(checks::relative_distance(wet.rate_of_small(H, dH), along) < 1e-12);
      CHECK(checks::relative_distance(wet.first_piola_of_small(H), wet.first_piola(H)) < 1e-12);
    }
  }
}

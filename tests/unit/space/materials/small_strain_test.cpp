// Laws at strains that are far below the rounding of 1: F = I + H has lost H there.
#include <stillpoint/hencky.hpp>
#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/logarithm.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

#include <catch2/catch.hpp>

#include "law_checks.hpp"
#include "space/materials/elastic_material.hpp"

using namespace stillpoint;
using checks::lame;
using enum StressState;

namespace {

template <class Law>
Gradient<Law::state> scaled(Gradient<Law::state> H, double by) {
  for (double& component : H) component *= by;
  return H;
}

constexpr double sizes[] = {1e-3, 1e-6, 1e-9, 1e-12, 1e-16, 1e-20, 1e-50, 1e-100};

}  // namespace

#define SAME_STATE(Law, S) (std::pair<Law<S>, LinearElastic<S>>)
#define SAME_STATES_OF(Law)                                                                          \
  SAME_STATE(Law, uniaxial_stress), SAME_STATE(Law, uniaxial_strain), SAME_STATE(Law, plane_strain), \
      SAME_STATE(Law, plane_stress), SAME_STATE(Law, axisymmetric), SAME_STATE(Law, space)

TEMPLATE_TEST_CASE(
    "a law of finite strain answers Hooke's stress to a strain of any smallness, to the digits that it has", "",
    SAME_STATES_OF(NeoHookean), SAME_STATES_OF(Hencky)) {
  using Law = typename TestType::first_type;
  const Law law(lame);
  const typename TestType::second_type hooke(lame);
  for (const auto& shape : checks::deformations<Law::state>()) {
    for (const double size : sizes) {
      const auto H = scaled<Law>(shape, size);
      CAPTURE(size, H);
      const double bound = 100 * size + 1e-14;  // terms of second order have no factor above 100; rounding
      CHECK(checks::relative_distance(law.first_piola(H), hooke.first_piola(H)) <= bound);
      CHECK(checks::relative_distance(law.cauchy(H), hooke.cauchy(H)) <= bound);
      CHECK(checks::relative_distance(law.moduli(H), hooke.moduli(H)) <= bound);
    }
  }
}

TEMPLATE_TEST_CASE("a small deformation is kept from phase to phase with all its digits", "", NeoHookean<plane_strain>,
                   Hencky<plane_strain>, NeoHookean<axisymmetric>, Hencky<axisymmetric>, NeoHookean<space>,
                   Hencky<space>) {
  constexpr Kinematics K = kinematics(TestType::state);
  const TestType law(lame);
  for (const auto& shape : checks::deformations<TestType::state>()) {
    for (const double size : sizes) {
      if (size > 1e-6) continue;
      const auto H = scaled<TestType>(shape, size);
      ElasticMaterial<TestType> material(law, 0, 1, true);
      PointBlock<K> block;
      block.count = 1;
      for (int phase = 0; phase < 3; ++phase) {
        for (std::size_t c = 0; c < H.size(); ++c) block.H[c][0] = H[c];
        material.end_phase(block);
      }
      CAPTURE(size, H);
      // (I + H)³ − I = 3 H + 3 H² + H³
      const auto square = product<K>(H, H), cube = product<K>(square, H);
      auto all = scaled<TestType>(H, 3);
      for (std::size_t c = 0; c < H.size(); ++c) all[c] += 3 * square[c] + cube[c];
      constexpr double E = 210, rounding = 1e-14;
      CHECK(largest_difference(material.cauchy({}, 0), law.cauchy(all)) <= rounding * E * size);
    }
  }
}

TEST_CASE("the logarithm of 1 + x keeps the digits of a small x and those of a large one") {
  for (const double x :
       {1e-300, -1e-20, 3e-17, 1e-12, -1e-9, 1e-5, -0.1, 0.2, 0.2499, 0.2501, -0.2501, -0.9, 3.0, 1e6}) {
    CAPTURE(x);
    const double exact = std::log1p(x);
    CHECK(std::abs(logarithm(1 + x, x) - exact) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(exact));
  }
  for (const double x : {-1.0, -2.0}) CHECK(std::isnan(logarithm(1 + x, x)));
}

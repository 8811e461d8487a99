#include <stillpoint/hencky.hpp>

#include <catch2/catch.hpp>

#include "law_checks.hpp"

using namespace stillpoint;
using checks::lame, checks::poisson, checks::young;
using enum StressState;

// That its moduli are the derivative of its stress, its objectivity and the limit of small strain are in
// material_law_test.cpp, for all elastic laws.

TEST_CASE("a Hencky bar: the Kirchhoff stress is E ln F, the section carries F^(2 nu - 1) of it") {
  for (const double F : {0.2, 0.999, 1.5, 4.0}) {
    const Hencky<uniaxial_stress> bar(lame);
    CHECK(bar.first_piola({F - 1})[0] == Approx(young * std::log(F) / F).epsilon(1e-12));
    CHECK(bar.cauchy({F - 1})[0] == Approx(young * std::log(F) * std::pow(F, 2 * poisson - 1)).epsilon(1e-12));
    const Hencky<uniaxial_strain> confined(lame);
    const double M = lame.lambda + 2 * lame.mu;
    CHECK(confined.cauchy({F - 1})[0] == Approx(M * std::log(F) / F).epsilon(1e-12));
    // and the same in the plane and along the axis
    CHECK(Hencky<plane_strain>(lame).cauchy({F - 1, 0, 0, 0})[0] == Approx(M * std::log(F) / F).epsilon(1e-12));
    CHECK(Hencky<axisymmetric>(lame).cauchy({0, 0, 0, F - 1, 0})[1] == Approx(M * std::log(F) / F).epsilon(1e-12));
    const double side = std::pow(F, -poisson) - 1;
    CHECK(Hencky<axisymmetric>(lame).first_piola({side, 0, 0, F - 1, side})[3] ==
          Approx(young * std::log(F) / F).epsilon(1e-12));
  }
}

TEST_CASE("Hencky simple shear: the logarithmic strain is asinh(gamma/2) along b") {
  // b = [[1 + γ², γ], [γ, 1]] has the eigenvalues e^(±2 asinh(γ/2)); so e = asinh(γ/2)/√(1 + γ²/4) [[γ/2, 1], [1,
  // −γ/2]].
  const Hencky<plane_strain> law(lame);
  for (const double gamma : {1e-3, 0.1, 0.19, 0.21, 1.0, 10.0, 1e4}) {
    const double e_xy = std::asinh(gamma / 2) / std::sqrt(1 + gamma * gamma / 4);
    const auto sigma = law.cauchy({0, gamma, 0, 0});
    CHECK(sigma[3] == Approx(2 * lame.mu * e_xy).epsilon(1e-12));
    // b_xx − b_yy rounds
    CHECK(sigma[0] == Approx(lame.mu * e_xy * gamma).epsilon(1e-12).margin(1e-14 * young));
    CHECK(sigma[1] == Approx(-lame.mu * e_xy * gamma).epsilon(1e-12).margin(1e-14 * young));
    CHECK(sigma[2] == Approx(0).margin(1e-12 * young));
  }
}

TEST_CASE("the logarithm of stretches that are nearly equal is as exact as of any others") {
  // τ_xx − τ_yy = 2 μ ln(s_x/s_y), for differences from rounding to large, on both sides of the change to the series
  const Hencky<plane_strain> law(lame);
  for (const double difference : {0.0, 1e-12, 1e-8, 1e-4, 0.05, 0.1002, 0.1005, 0.3, 2.0}) {
    const double s_x = 1.3 * (1 + difference), s_y = 1.3;
    const auto sigma = law.cauchy({s_x - 1, 0, 0, s_y - 1});
    // s_x and s_y are rounded: 1e-16 of the strain
    CHECK(s_x * s_y * (sigma[0] - sigma[1]) ==
          Approx(2 * lame.mu * std::log(s_x / s_y)).epsilon(1e-12).margin(1e-13 * young));
  }
}

TEST_CASE("Hencky's moduli have no jump where the eigenvalues are nearly equal") {
  // x = r/m = 0.1 at (s_x/s_y)² = 1.1/0.9: either side of it, against differences of the stress
  const Hencky<plane_strain> law(lame);
  const double ratio = std::sqrt(1.1 / 0.9);
  for (const double s_x : {ratio * 0.9999, ratio * 1.0001, 1 + 1e-7, 1 + 1e-9, 1.0}) {
    const Gradient<plane_strain> H = {s_x - 1, 0.01 * (s_x - 1), 0, 0};
    const auto exact = checks::differences<plane_strain>([&](const auto& at) { return law.first_piola(at); }, H);
    CHECK(checks::relative_distance(law.moduli(H), exact) < 1e-8);  // rounding/d
  }
}

TEST_CASE("Hencky's stress derives from its energy") {
  constexpr double d = 1e-6;
  const Hencky<axisymmetric> law(lame);
  // W = μ tr(e²) + λ/2 (tr e)² from the principal stretches
  const auto W = [](const Gradient<axisymmetric>& H) {
    const PlaneTensor F = deformation_gradient<axisymmetric>(H), b = F * transpose(F);
    const double m = (b.xx + b.yy) / 2, r = std::hypot((b.xx - b.yy) / 2, b.xy);
    const double e1 = std::log(m + r) / 2, e2 = std::log(m - r) / 2, e3 = std::log(F.zz);
    return lame.mu * (e1 * e1 + e2 * e2 + e3 * e3) + lame.lambda / 2 * (e1 + e2 + e3) * (e1 + e2 + e3);
  };
  for (const auto& H : checks::deformations<axisymmetric>()) {
    Gradient<axisymmetric> P{};
    for (std::size_t a = 0; a < P.size(); ++a) {
      auto above = H, below = H;
      above[a] += d;
      below[a] -= d;
      P[a] = (W(above) - W(below)) / (2 * d);
    }
    CHECK(checks::relative_distance(P, law.first_piola(H)) == Approx(0).margin(1e-8 * young));  // rounding/d
  }
}

TEST_CASE("stretching along fixed axes is path-independent: logarithmic strains add") {
  // 2 μ ln(s² ) = twice 2 μ ln s
  const Hencky<uniaxial_strain> law(lame);
  const double s = 1.7, once = law.first_piola({s - 1})[0] * s, twice = law.first_piola({s * s - 1})[0] * s * s;
  CHECK(twice == Approx(2 * once).epsilon(1e-14));
}

#include <stillpoint/drucker_prager_cone.hpp>

#include <cmath>

#include <catch2/catch.hpp>

#include "law_checks.hpp"

using namespace stillpoint;
using checks::one_degree;

TEST_CASE("in plane strain the cone of no dilatancy is eta = sin phi, xi = cos phi") {
  for (const double phi : {0.0, 20.0, 35.0}) {
    const auto cone = ConeCoefficients::from(Cone::plane_strain, phi, 0);
    CHECK(cone.eta == Approx(std::sin(phi * one_degree)).epsilon(1e-15));
    CHECK(cone.xi == Approx(std::cos(phi * one_degree)).epsilon(1e-15));
    CHECK(cone.eta_bar == 0);
  }
}

TEST_CASE("the associated cone of plane strain is Drucker and Prager's 3 tan phi/sqrt(9 + 12 tan^2 phi)") {
  for (const double phi : {10.0, 30.0, 45.0}) {
    const auto cone = ConeCoefficients::from(Cone::plane_strain, phi, phi);
    const double t = std::tan(phi * one_degree), root = std::sqrt(9 + 12 * t * t);
    CHECK(cone.eta == Approx(3 * t / root).epsilon(1e-14));
    CHECK(cone.eta_bar == Approx(cone.eta).epsilon(1e-14));
    CHECK(cone.xi == Approx(3 / root).epsilon(1e-14));
  }
}

TEST_CASE("the mean cone has eta = 0.687 at 35 degrees, half-way between the edges' cones") {
  CHECK(ConeCoefficients::from(Cone::mean, 35, 0).eta == Approx(0.687).margin(0.0005));  // three digits are published
  const double outer = ConeCoefficients::from(Cone::compression, 35, 0).eta;
  const double inner = ConeCoefficients::from(Cone::extension, 35, 0).eta;
  CHECK(ConeCoefficients::from(Cone::mean, 35, 0).eta == Approx((outer + inner) / 2).epsilon(1e-14));
}

TEST_CASE("the edges' cones at 30 degrees are 6/(5 sqrt 3) and 6/(7 sqrt 3)") {
  CHECK(ConeCoefficients::from(Cone::compression, 30, 0).eta == Approx(6 / (5 * std::sqrt(3.0))).epsilon(1e-14));
  CHECK(ConeCoefficients::from(Cone::extension, 30, 0).eta == Approx(6 / (7 * std::sqrt(3.0))).epsilon(1e-14));
}

TEST_CASE("every cone has its apex at c cot phi, and an associated one flows normal to itself") {
  for (const auto& [word, kind] : cone_words) {
    INFO(word);
    CHECK(cone_of(word) == kind);
    const auto cone = ConeCoefficients::from(kind, 25, 10);
    CHECK(cone.xi / cone.eta == Approx(1 / std::tan(25 * one_degree)).epsilon(1e-14));
    const auto associated = ConeCoefficients::from(kind, 25, 25);
    CHECK(associated.eta_bar == Approx(associated.eta).epsilon(1e-14));
  }
  CHECK_THROWS_AS(cone_of("egg"), std::invalid_argument);
}

// Beside tables: Abramowitz and Stegun 1964, and what the functions are the inverse or the derivative of.
#include "base/special_functions.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "largest.hpp"

using namespace stillpoint;

TEST_CASE("Lambert's W is the inverse of w e^w") {
  Largest error;
  for (const double x : {1e-12, 1e-3, 0.5, 1.0, 10.0, 1e6, -0.3})
    error.take_magnitude(lambert_w(x) * std::exp(lambert_w(x)) / x - 1);
  CHECK(error.value() < 1e-14);
  CHECK(lambert_w(1) == Approx(0.567143290409783873).epsilon(1e-15));  // the omega constant
  CHECK(std::isnan(lambert_w(-1)));                                    // and the program lives
}

TEST_CASE("elliptic integrals are those of Abramowitz and Stegun's tables") {
  const double k = std::sin(30 * std::numbers::pi / 180);
  CHECK(elliptic_k(k) == Approx(1.68575035481259604).epsilon(1e-15));                     // table 17.2
  CHECK(elliptic_f(30 * std::numbers::pi / 180, k) == Approx(0.52942863).epsilon(1e-8));  // table 17.5
  CHECK(elliptic_e(30 * std::numbers::pi / 180, k) == Approx(0.51788193).epsilon(1e-8));  // table 17.6
  CHECK(elliptic_f(std::numbers::pi / 2, k) == Approx(elliptic_k(k)).epsilon(1e-14));
  CHECK(std::isnan(elliptic_k(1.5)));
  const auto [sn, cn] = jacobi(elliptic_f(0.7, k), k);
  CHECK(sn == Approx(std::sin(0.7)).epsilon(1e-13));
  CHECK(cn == Approx(std::cos(0.7)).epsilon(1e-13));
}

TEST_CASE("Bessel's functions have their zeros where the tables have them") {
  CHECK(std::abs(bessel_j0(2.404825557695773)) < 1e-15);
  CHECK(std::abs(bessel_j1(3.831705970207512)) < 1e-15);
  CHECK(bessel_j1(1) == Approx(0.440050585744933516).epsilon(1e-15));
}

TEST_CASE("a relative exponential keeps its digits near 0") {
  CHECK(relative_exponential_2(0) == 1);
  CHECK(relative_exponential_2(1e-9) == Approx(1 + 1e-9 / 3).epsilon(1e-15));
  CHECK(relative_exponential_2(1) == Approx(2 * (std::exp(1) - 2)).epsilon(1e-14));
}

TEST_CASE("a zero is found to rounding, and one that is not there is an error") {
  CHECK(zero_between(0, 2, [](double x) { return std::cos(x); }) == Approx(std::numbers::pi / 2).epsilon(1e-15));
  CHECK(zero_between(0, 1e-9, [](double x) { return x * x - 1e-20; }) == Approx(1e-10).epsilon(1e-12));
  CHECK_THROWS_AS(zero_between(0, 1, [](double x) { return x + 1; }), std::domain_error);
  CHECK_THROWS_AS(zero_between(-1, 1, [](double) { return std::nan(""); }), std::domain_error);
}

TEST_CASE("Legendre's polynomials are those of their recursion, and Student's quantiles those of a table") {
  Largest error;
  for (const double x : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
    error.take_magnitude(legendre(0, x) - 1);
    error.take_magnitude(legendre(1, x) - x);
    for (int k = 1; k < 9; ++k)  // (k + 1) P_k+1 = (2k + 1) x P_k − k P_k−1
      error.take_magnitude((k + 1) * legendre(k + 1, x) - (2 * k + 1) * x * legendre(k, x) + k * legendre(k - 1, x));
  }
  CHECK(error.value() < 1e-14);
  CHECK(student_quantile(0.975, 1) == Approx(12.7062).epsilon(1e-6));  // Abramowitz and Stegun, table 26.10
  CHECK(student_quantile(0.975, 10) == Approx(2.22814).epsilon(1e-6));
}

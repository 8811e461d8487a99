#include <stillpoint/exponential.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "largest.hpp"

using stillpoint::exponential;
using stillpoint::exponential_minus_1;

TEST_CASE("the inlined exponential is within one unit in the last place, and less 1 within two") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> far(-700, 700), near(-2, 2), tiny(-300, 0);
  Largest worst, worst_minus_1;
  const auto error = [](double value, long double exact) {
    const double size = std::abs(static_cast<double>(exact)), ulp = std::nextafter(size, 1e308) - size;
    return static_cast<double>(value - exact) / ulp;
  };
  for (int i = 0; i < 100000; ++i) {
    for (const double x : {far(random), near(random), std::pow(10, tiny(random)), -std::pow(10, tiny(random))}) {
      worst.take_magnitude(error(exponential(x), std::exp(static_cast<long double>(x))));
      worst_minus_1.take_magnitude(error(exponential_minus_1(x), std::expm1(static_cast<long double>(x))));
    }
  }
  CHECK(worst.value() < 1);
  CHECK(worst_minus_1.value() < 2);
  CHECK(exponential(0) == 1);
  CHECK(exponential_minus_1(0) == 0);
}

TEST_CASE("the exponential goes to its limits beyond the numbers, and keeps what is not a number") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {710.0, 1e300, infinity}) {
    CHECK(exponential(x) == infinity);
    CHECK(exponential_minus_1(x) == infinity);
  }
  for (const double x : {-710.0, -1e300, -infinity}) {
    CHECK(exponential(x) == 0);
    CHECK(exponential_minus_1(x) == -1);
  }
  CHECK(std::isnan(exponential(std::nan(""))));
  CHECK(std::isnan(exponential_minus_1(std::nan(""))));
}

TEST_CASE("the exponential of a Dual has its own value as derivative") {
  const stillpoint::Dual<1> x(0.3, {2});
  CHECK(exponential(x).derivative[0] == Approx(2 * std::exp(0.3)).epsilon(1e-15));
  CHECK(exponential_minus_1(x).derivative[0] == Approx(2 * std::exp(0.3)).epsilon(1e-15));
}

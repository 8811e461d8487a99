#include <stillpoint/logarithm.hpp>

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "largest.hpp"

using stillpoint::logarithm;

TEST_CASE("the inlined logarithm is within one unit in the last place") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-700, 700), near(0.5, 2), nearer(0.999, 1.001);
  Largest worst;
  for (int i = 0; i < 100000; ++i) {
    for (const double x : {std::exp(exponent(random)), near(random), nearer(random)}) {
      const long double exact = std::log(static_cast<long double>(x));
      const double size = std::abs(static_cast<double>(exact)), ulp = std::nextafter(size, 1e300) - size;
      worst.take_magnitude(static_cast<double>(logarithm(x) - exact) / ulp);
    }
  }
  CHECK(worst.value() < 1);
  CHECK(logarithm(1) == 0);
}

TEST_CASE("what has no finite logarithm is not a number") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, -0.0, -1.0, -infinity, infinity, std::nan("")}) CHECK(std::isnan(logarithm(x)));
  CHECK(logarithm(std::numeric_limits<double>::max()) == Approx(1024 * std::log(2.0)).epsilon(1e-15));
  CHECK(logarithm(std::numeric_limits<double>::min()) == Approx(-1022 * std::log(2.0)).epsilon(1e-15));
}

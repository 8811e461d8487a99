#include "geometry/gauss_rule.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "largest.hpp"

using namespace stillpoint;

TEST_CASE("Gauss's rule of n points is exact to degree 2n - 1 and no further, with its points in order") {
  for (const int n : {1, 2, 3, 4, 5, 8, 12}) {
    const GaussRule rule(1, 3, static_cast<std::size_t>(n));
    const auto error = [&](int degree) {  // relative, of ∫ (x − 1)^degree
      double sum = 0;
      for (std::size_t k = 0; k < rule.at.size(); ++k) sum += rule.weight[k] * std::pow(rule.at[k] - 1, degree);
      return sum * (degree + 1) / std::pow(2, degree + 1) - 1;
    };
    Largest within;
    for (int degree = 0; degree < 2 * n; ++degree) within.take_magnitude(error(degree));
    CHECK(within.value() < 1e-14);
    if (n < 8) CHECK(std::abs(error(2 * n)) > 1e-7);
    for (std::size_t k = 1; k < rule.at.size(); ++k) CHECK(rule.at[k - 1] < rule.at[k]);
  }
}

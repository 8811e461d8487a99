#include "largest.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

namespace {
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

TEST_CASE("the largest and the smallest of numbers are those, whatever their signs and order") {
  CHECK(largest_value(std::vector{-3.0, -1.0, -2.0}) == -1);
  CHECK(smallest_value(std::vector{3.0, 1.0, 2.0}) == 1);
  CHECK(largest_magnitude(std::vector{1.0, -3.0, 2.0}) == 3);
  CHECK(largest_difference(std::vector{1.0, 2.0, 3.0}, std::vector{1.5, 2.0, 1.0}) == 2);
  CHECK(largest_magnitude(std::vector{1.0, -infinity}) == infinity);
}

TEST_CASE(
    "one NaN among the values, wherever it is, makes their largest, smallest and difference NaN, which no bound "
    "passes") {
  const std::vector<double> zeros(3, 0.0);
  for (std::size_t place = 0; place < zeros.size(); ++place) {
    std::vector<double> values = zeros;
    values[place] = not_a_number;
    for (const double value : {largest_value(values), smallest_value(values), largest_magnitude(values),
                               largest_difference(values, zeros), largest_difference(zeros, values)}) {
      CHECK(std::isnan(value));
      CHECK_FALSE(value < infinity);
      CHECK_FALSE(value >= 0);
    }
  }
}

TEST_CASE("the largest of no values, and the difference of ranges of two lengths, are NaN: nothing was compared") {
  const std::vector<double> none;
  CHECK(std::isnan(largest_value(none)));
  CHECK(std::isnan(smallest_value(none)));
  CHECK(std::isnan(largest_magnitude(none)));
  CHECK(std::isnan(largest_difference(none, none)));
  CHECK(std::isnan(largest_difference(std::vector{1.0}, std::vector{1.0, 2.0})));
}

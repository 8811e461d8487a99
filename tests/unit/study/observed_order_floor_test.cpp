// Errors that are rounding, or what a solver has left, say nothing about the order of a method.
#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "study/observed_order.hpp"

using namespace stillpoint;

namespace {

using Levels = std::vector<double>;
const Levels halved_sizes = {1, 0.5, 0.25, 0.125, 0.0625};

}  // namespace

TEST_CASE("no order is fitted to errors that are no more than their floor, however regularly they fall") {
  const Levels falling = {1e-10, 4e-13, 1.5e-15, 6e-18, 2.4e-20};  // "order 8"
  CHECK(observed_order(halved_sizes, falling));
  CHECK_FALSE(observed_order(halved_sizes, falling, Levels(5, 1e-10)));
  CHECK_FALSE(observed_order(halved_sizes, falling, Levels{1e-9, 1e-13, 1e-14, 1e-14, 1e-14}));
}

TEST_CASE("the order is that of the levels above their floor, to rounding") {
  const Levels errors = {4e-2, 1e-2, 2.5e-3, 3e-9, 1e-12};
  const auto found = observed_order(halved_sizes, errors, Levels{1e-8, 1e-8, 1e-8, 1e-8, 1e-8});
  REQUIRE(found);
  CHECK(found->order == Approx(2).epsilon(1e-12));
  CHECK(found->first == 0);
  CHECK(found->last == 2);
  const auto of_two = observed_order(halved_sizes, errors, Levels{1e-8, 1e-8, 3e-3, 1e-8, 1e-8});
  REQUIRE(of_two);
  CHECK(of_two->order == Approx(2).epsilon(1e-12));
  CHECK(std::isnan(of_two->low));
}

TEST_CASE("errors that are not numbers, and floors that are not, leave nothing of which there would be an order") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(observed_order(halved_sizes, Levels(5, none), Levels(5, 0)));
  CHECK_FALSE(observed_order(halved_sizes, Levels{1, 0.5, 0.25, 0.1, 0.05}, Levels(5, none)));
}

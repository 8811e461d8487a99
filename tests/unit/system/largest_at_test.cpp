// Where a failure is said to be.
#include "system/largest_at.hpp"

#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"

using namespace stillpoint;
using Values = std::vector<double>;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the largest entry is that of the largest magnitude, the first of equals, and a NaN before all others") {
  CHECK(largest_entry(Values{1, -3, 2}) == 1);
  CHECK(largest_entry(Values{2, -2, 1}) == 0);
  CHECK(largest_entry(Values{infinite, not_a_number, not_a_number}) == 1);
}

TEST_CASE("a system that knows no positions says the number of the unknown, counted from 1") {
  const test::Chain chain({.n = 3});
  CHECK(largest_at(chain, Values{0, 0, -1}) == "degree of freedom 3");
  CHECK(largest_at(chain, Values{}) == "no degree of freedom");
}

TEST_CASE("a motion that diverges is said to do so where it was fastest, or where it is first not finite") {
  const test::Chain chain({.n = 2});
  const Values bad = {0, 0, infinite, not_a_number};
  CHECK(divergence_at(chain, Values{9, 0, 1, -2.5}, bad) ==
        "the motion before was fastest, 2.5 m/s, at degree of freedom 2");
  CHECK(divergence_at(chain, Values(4), bad) == "it is not at degree of freedom 1");
  CHECK(divergence_at(chain, Values(4), Values{0, not_a_number, infinite, 0}) == "it is not at degree of freedom 2");
  CHECK(divergence_at(chain, Values(4), Values(4)) == "it has grown beyond all numbers");
}

TEST_CASE("a place has its position, the material point beside it and its cell, in any number of dimensions") {
  CHECK(to_string(
            PlaceInBody{.what = "the node", .position = {1.5}, .cell = {2}, .material_point = "material point 3"}) ==
        "the node at x = 1.5 beside material point 3 in cell 2");
  CHECK(to_string(PlaceInBody{.what = "the node", .position = {1, 0.5}, .cell = {3, 1}}) ==
        "the node at (1, 0.5) in cell (3, 1)");
  CHECK(to_string(PlaceInBody{.what = "the body"}) == "the body");
}

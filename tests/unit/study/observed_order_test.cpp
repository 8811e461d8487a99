#include "study/observed_order.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

using Levels = std::vector<double>;
const Levels halved = {1, 0.5, 0.25, 0.125, 0.0625};

template <class Error>
std::vector<double> errors(const Error& of) {
  std::vector<double> found;
  for (const double h : halved) found.push_back(of(h));
  return found;
}

}  // namespace

TEST_CASE("an error C h^p has the order p, and an interval of rounding") {
  const auto found = observed_order(halved, errors([](double h) { return 3 * std::pow(h, 2.5); }));
  REQUIRE(found);
  CHECK(found->order == Approx(2.5).epsilon(1e-12));
  CHECK(found->high - found->low < 1e-6);
  CHECK(found->first == 0);
  CHECK(found->last == 4);
}

TEST_CASE("the interval of an order is Student's: 12.7 standard errors of three levels") {
  // log2 e = 0, −2, −5: slope 2.5, residuals −1/6, 1/3, −1/6, standard error √((1/6)/1/2)
  const std::vector<double> sizes = {4, 2, 1}, e = {1, 0.25, 1.0 / 32};
  const auto found = observed_order(sizes, e);
  REQUIRE(found);
  CHECK(found->order == Approx(2.5));
  CHECK(found->high - found->order == Approx(12.7062 * std::sqrt(1.0 / 12)).epsilon(1e-4));
  CHECK(found->order - found->low == Approx(found->high - found->order));
}

TEST_CASE("levels before the error falls as it does in the end, and after it has ceased to fall, are left out") {
  const auto with_floor = observed_order(halved, Levels{8, 2, 0.5, 0.3, 0.29});
  REQUIRE(with_floor);
  CHECK(with_floor->order == Approx(2).epsilon(1e-12));
  CHECK(with_floor->last == 2);
  const auto with_start = observed_order(halved, Levels{0.5, 0.49, 0.25, 0.0625, 0.015625});
  REQUIRE(with_start);
  CHECK(with_start->order == Approx(2).epsilon(1e-12));
  CHECK(with_start->first == 2);
}

TEST_CASE("errors that are not there or 0 have no part in an order, and two levels give no interval") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(observed_order(halved, Levels{1, 0, none, 0, none}));
  CHECK_FALSE(observed_order(halved, Levels{none, none, none, none, 0.1}));
  const auto found = observed_order(halved, Levels{none, none, none, 0.4, 0.1});
  REQUIRE(found);
  CHECK(found->order == Approx(2));
  CHECK(std::isnan(found->low));
  CHECK(std::isnan(found->high));
}

TEST_CASE("differences of levels fall like the error, and extrapolation finds the limit") {
  const auto value = [](double h) { return 7 - 0.3 * h * h * h; };
  const std::vector<double> values = errors(value);
  const auto found = observed_order(halved, differences(values));
  REQUIRE(found);
  CHECK(found->order == Approx(3).epsilon(1e-9));
  CHECK(found->last == 3);
  CHECK(extrapolated(values[3], values[4], 2, found->order) == Approx(7).epsilon(1e-12));
}

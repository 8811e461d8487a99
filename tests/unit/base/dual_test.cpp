#include <stillpoint/dual.hpp>

#include <catch2/catch.hpp>

using stillpoint::Directional;
using stillpoint::Dual;
using stillpoint::value_of;
using stillpoint::variables;

TEST_CASE("dual numbers carry the exact derivatives of sums, products, quotients and roots") {
  const auto f = [](const auto& x, const auto& y) {
    using std::sqrt;
    return -x + 2 * y - x * y / (1 + y) + sqrt(x * x + 3) - (y > x ? 5 - y : y);
  };
  const double x = 1.7, y = 0.6;
  const auto [X, Y] = variables(std::array{x, y});
  const Dual<2> z = f(X, Y);
  CHECK(value_of(z) == f(x, y));
  CHECK(z.derivative[0] == Approx(-1 - y / (1 + y) + x / std::sqrt(x * x + 3)).epsilon(1e-15));
  CHECK(z.derivative[1] == Approx(2 - x / ((1 + y) * (1 + y)) - 1).epsilon(1e-15));
  CHECK(f(X, Dual<2>(3)).derivative[1] == 0);  // a constant has none
}

TEST_CASE("a directional number carries the derivative along its direction") {
  const auto f = [](const auto& x, const auto& y) {
    using std::sqrt;
    return 2 * y - x * y / (1 + y) + sqrt(x * x + 3) - 5;
  };
  const double x = 1.7, y = 0.6, dx = 0.4, dy = -1.3;
  const auto [X, Y] = variables(std::array{x, y});
  const Dual<2> expected = f(X, Y);
  const Directional z = f(Directional(x, dx), Directional(y, dy));
  CHECK(value_of(z) == Approx(f(x, y)).epsilon(1e-15));
  CHECK(z.rate == Approx(dx * expected.derivative[0] + dy * expected.derivative[1]).epsilon(1e-15));
  CHECK(f(Directional(x), Directional(y)).rate == 0);
}

#include "base/line_fit.hpp"

#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

TEST_CASE("a line far from the origin is found with the variance of its slope") {
  const std::vector<double> x = {1e6 + 1, 1e6 + 2, 1e6 + 3, 1e6 + 4};
  const std::vector<double> y = {3, 5, 5, 7};  // 5 + 1.2 (x − x̄), off by −0.2, 0.6, −0.6, 0.2
  const LineFit line = fit_line(x, y);
  CHECK(line.slope == Approx(1.2).epsilon(1e-13));
  CHECK(line.at_zero + line.slope * 1e6 == Approx(2).epsilon(1e-8));
  CHECK(line.slope_variance == Approx(0.8 / (2 * 5)).epsilon(1e-13));
}

#include "space/points/local_fit.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using stillpoint::local_fit;

namespace {

double sum(const std::vector<double>& c, const std::vector<double>& s) {
  double all = 0;
  for (std::size_t p = 0; p < c.size(); ++p) all += c[p] * s[p];
  return all;
}

}  // namespace

TEST_CASE("a local fit gives back every polynomial of its degree, wherever the points lie") {
  std::mt19937 random(3);
  const auto anywhere = [&] { return std::uniform_real_distribution<>(-1, 1)(random); };
  for (int degree = 0; degree <= 3; ++degree) {
    for (const std::size_t dim : {1, 2}) {
      std::vector<double> xi, weight, values;
      for (int p = 0; p < 40; ++p) {
        for (std::size_t d = 0; d < dim; ++d) xi.push_back(anywhere());
        weight.push_back(1.5 + anywhere());
        const double x = xi[dim * static_cast<std::size_t>(p)], y = dim == 2 ? xi.back() : 0;
        values.push_back(0.7 + (degree > 0 ? 3 * x - 2 * y : 0) + (degree > 1 ? x * x - 4 * x * y + y * y : 0) +
                         (degree > 2 ? 5 * x * x * y - x * x * x : 0));
      }
      CAPTURE(degree, dim);
      CHECK(sum(local_fit(xi, weight, dim, degree), values) == Approx(0.7).epsilon(1e-12));
    }
  }
}

TEST_CASE("a local fit takes a lower degree where points leave one open, or far outside of them") {
  // Two points determine no parabola, points on a line no slope across it.
  CHECK(sum(local_fit({0.5, 1}, {1, 1}, 1, 2), {3, 5}) == Approx(1).epsilon(1e-12));
  CHECK(sum(local_fit({-1, 0, 0.5, 0, 1, 0}, {1, 1, 1}, 2, 1), {7, 7, 7}) == Approx(7).epsilon(1e-12));
  // One hundred distances away a line through two points says nothing: their mean.
  CHECK(sum(local_fit({1, 1.01}, {1, 1}, 1, 1), {3, 5}) == Approx(4).epsilon(1e-12));
  CHECK(local_fit({0.3}, {2}, 1, 3) == std::vector<double>{1});
}

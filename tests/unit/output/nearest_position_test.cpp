#include "output/nearest_position.hpp"

#include <random>
#include <vector>

#include <catch2/catch.hpp>

using stillpoint::NearestPosition;

namespace {

std::size_t first_of_all(const std::vector<double>& positions, const std::vector<double>& x) {
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t p = 0; p < positions.size() / x.size(); ++p) {
    double square = 0;
    for (std::size_t d = 0; d < x.size(); ++d)
      square += (positions[x.size() * p + d] - x[d]) * (positions[x.size() * p + d] - x[d]);
    if (square < least) least = square, best = p;
  }
  return best;
}

}  // namespace

TEST_CASE("the nearest position is the first of those that a look at all of them finds") {
  std::mt19937 random(7);
  for (const std::size_t dim : {1, 2}) {
    for (const unsigned distinct : {1u, 3u, 20u, 100'000u}) {  // few of them: many as near as each other
      const auto coordinate = [&] { return static_cast<double>(random() % distinct) / distinct; };
      std::vector<double> positions(dim * 200);
      for (double& x : positions) x = coordinate();
      const NearestPosition nearest(positions, dim);
      for (int k = 0; k < 200; ++k) {
        std::vector<double> x(dim);
        for (double& along : x) along = 1.5 * coordinate() - 0.25;
        CAPTURE(dim, distinct, x);
        CHECK(nearest.to(x) == first_of_all(positions, x));
      }
    }
  }
}

// The tree of boxes finds what a search through all of them finds, and looks at few of them.
#include "geometry/box_tree.hpp"

#include <catch2/catch.hpp>

#include "random_values.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

double squared_distance(const SpacePoint& a, const SpacePoint& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

std::vector<SpacePoint> points_by_chance(std::size_t count, unsigned seed) {
  const std::vector<double> values = random_values(3 * count, 1, seed);
  std::vector<SpacePoint> points;
  for (std::size_t k = 0; k < count; ++k) points.push_back({values[3 * k], values[3 * k + 1], values[3 * k + 2]});
  return points;
}

}  // namespace

TEST_CASE("the nearest of a thousand points is found, after a look at a fiftieth of them") {
  for (const std::size_t count : {1UL, 2UL, 5UL, 37UL, 1000UL}) {
    const std::vector<SpacePoint> points = points_by_chance(count, 1);
    std::vector<SpaceBox> boxes;
    for (const SpacePoint& x : points) boxes.push_back({x, x});
    const BoxTree tree(boxes);
    std::size_t looks = 0, wrong = 0;
    for (const SpacePoint& x : points_by_chance(200, 2)) {
      const auto to = [&](std::size_t k) { return ++looks, squared_distance(points[k], x); };
      std::size_t nearest = 0;
      for (std::size_t k = 0; k < count; ++k)
        if (squared_distance(points[k], x) < squared_distance(points[nearest], x)) nearest = k;
      wrong += tree.nearest(x, to) != nearest;
    }
    CHECK(wrong == 0);
    if (count == 1000) CHECK(looks < 200 * count / 50);
  }
}

TEST_CASE("a thing whose box is near is no nearer than its own distance") {
  // The first box contains x, but what is in it is farther away than the second.
  const BoxTree tree({{{-1, -1, -1}, {1, 1, 1}}, {{0.5, 0, 0}, {0.5, 0, 0}}});
  CHECK(tree.nearest({0, 0, 0}, [](std::size_t k) { return k == 0 ? 3 : 0.25; }) == 1);
}

TEST_CASE("things that all lie in one position are told apart by their distances alone") {
  const BoxTree tree(std::vector<SpaceBox>(100, SpaceBox{{1, 1, 1}, {1, 1, 1}}));
  CHECK(tree.nearest({0, 0, 0}, [](std::size_t k) { return k == 77 ? 3.0 : 4.0; }) == 77);
}

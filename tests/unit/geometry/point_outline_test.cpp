#include "geometry/point_outline.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

struct Cloud {
  std::vector<double> x, y, area;
  void add(double px, double py, double a) {
    x.push_back(px);
    y.push_back(py);
    area.push_back(a);
  }
  std::vector<Polygon> outline() const { return outline_of_points(x, y, area); }
};

/// Squares of side h, those of which the middle is in the body have a point there.
template <class Inside>
Cloud lattice(int columns, int rows, double h, const Inside& inside) {
  Cloud cloud;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double x = h * (i + 0.5), y = h * (j + 0.5);
      if (inside(x, y)) cloud.add(x, y, h * h);
    }
  }
  return cloud;
}

}  // namespace

TEST_CASE("the outline of a lattice of points is the border of its squares, counter-clockwise") {
  const auto outline = lattice(20, 7, 0.1, [](double, double) { return true; }).outline();
  REQUIRE(outline.size() == 1);
  REQUIRE(outline[0].size() == 4);
  CHECK(signed_area(outline[0]) == Approx(2 * 0.7).epsilon(1e-12));
  for (const PlanePoint& corner : outline[0]) {
    CHECK(std::min(std::abs(corner[0]), std::abs(corner[0] - 2)) < 1e-12);
    CHECK(std::min(std::abs(corner[1]), std::abs(corner[1] - 0.7)) < 1e-12);
  }
}

TEST_CASE("a hole has an outline that runs the other way round, so that the body is on the left of both") {
  const auto outline = lattice(30, 30, 0.1, [](double x, double y) {
                         return std::abs(x - 1.5) > 0.5 || std::abs(y - 1.5) > 0.5;
                       }).outline();
  REQUIRE(outline.size() == 2);
  const double a = signed_area(outline[0]), b = signed_area(outline[1]);
  CHECK(std::max(a, b) == Approx(9).epsilon(1e-12));
  CHECK(std::min(a, b) == Approx(-1).epsilon(0.05));  // its corners are cut off by half a spacing
}

TEST_CASE("the outline of a disc of scattered points is nowhere farther than a spacing from the circle") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-0.03, 0.03);
    const double h = 0.1, radius = 1.8;
    Cloud disc;
    for (int i = -20; i < 20; ++i) {
      for (int j = -20; j < 20; ++j) {
        const double x = h * (i + 0.5) + shift(random), y = h * (j + 0.5) + shift(random);
        if (std::hypot(x, y) < radius) disc.add(x, y, h * h);
      }
    }
    const auto outline = disc.outline();
    REQUIRE(outline.size() == 1);
    CHECK(signed_area(outline[0]) == Approx(M_PI * radius * radius).epsilon(0.02));
    for (const PlanePoint& corner : outline[0]) CHECK(std::abs(std::hypot(corner[0], corner[1]) - radius) < h);
  }
}

TEST_CASE("two bodies of points have an outline each, and points of unlike volume their own spacing") {
  Cloud two = lattice(10, 10, 0.1, [](double, double) { return true; });
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) two.add(3.25 + 0.5 * i, 0.25 + 0.5 * j, 0.25);
  }
  auto outline = two.outline();
  REQUIRE(outline.size() == 2);
  CHECK(signed_area(outline[0]) + signed_area(outline[1]) == Approx(1 + 4).epsilon(1e-12));
}

TEST_CASE("a row of points, or two, has no outline") {
  CHECK(outline_of_points({0, 1}, {0, 0}, {1, 1}).empty());
  CHECK(outline_of_points({0, 1, 2, 3}, {0, 0, 0, 0}, {1, 1, 1, 1}).empty());
  CHECK(outline_of_points({0, 100, 0}, {0, 0, 100}, {1, 1, 1}).empty());  // too far apart to be one body
}

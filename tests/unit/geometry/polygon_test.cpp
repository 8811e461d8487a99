#include "geometry/polygon.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

const Polygon kTriangle = {{0, 0}, {2, 0}, {0, 3}};
// A horseshoe, open to the right.
const Polygon kHorseshoe = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}};

Polygon reversed(Polygon polygon) { return {polygon.rbegin(), polygon.rend()}; }

/// The polygon as seen from a square [x, x + h] × [y, y + h] taken for the unit square.
Polygon seen_from(const Polygon& polygon, double x, double y, double h) {
  Polygon local;
  for (const auto& corner : polygon) local.push_back({(corner[0] - x) / h, (corner[1] - y) / h});
  return local;
}

}  // namespace

TEST_CASE("area and centroid of a polygon are those of its parts, whichever way round it is written") {
  CHECK(signed_area(kTriangle) == Approx(3));
  CHECK(signed_area(reversed(kTriangle)) == Approx(-3));
  CHECK(centroid(kTriangle)[0] == Approx(2.0 / 3));
  CHECK(centroid(kTriangle)[1] == Approx(1));
  CHECK(signed_area(kHorseshoe) == Approx(7));
  // 3×3 about (1.5, 1.5) without 2×1 about (2, 1.5)
  for (const Polygon& horseshoe : {kHorseshoe, reversed(kHorseshoe)}) {
    CHECK(centroid(horseshoe)[0] == Approx((9 * 1.5 - 2 * 2) / 7));
    CHECK(centroid(horseshoe)[1] == Approx(1.5));
  }
}

TEST_CASE("the gap of a horseshoe is outside of it") {
  CHECK(contains(kHorseshoe, {0.5, 1.5}));
  CHECK(contains(kHorseshoe, {2, 0.5}));
  CHECK_FALSE(contains(kHorseshoe, {2, 1.5}));
  CHECK_FALSE(contains(kHorseshoe, {-0.1, 1.5}));
  CHECK_FALSE(contains(kHorseshoe, {4, 0.5}));
}

TEST_CASE("squares that tile the plane share out a polygon to rounding") {
  // A star, non-convex, with oblique edges and far from the tiles' lines.
  Polygon star;
  for (int k = 0; k < 14; ++k) {
    const double angle = 2 * std::numbers::pi * k / 14 + 0.1, r = k % 2 == 0 ? 2.9 : 1.1;
    star.push_back({3.03 + r * std::cos(angle), 2.96 + r * std::sin(angle)});
  }
  for (const Polygon& polygon : {kHorseshoe, star, reversed(star)}) {
    for (const double h : {0.31, 0.5, 1.0, 1.7}) {
      double area = 0;
      PlanePoint moment{0, 0};
      for (double x = 0; x < 6; x += h) {
        for (double y = 0; y < 6; y += h) {
          const Polygon part = clipped_to_unit_square(seen_from(polygon, x, y, h));
          const double share = signed_area(part) * h * h;
          area += share;
          if (std::abs(share) < 1e-9) continue;
          moment[0] += share * (x + h * centroid(part)[0]);
          moment[1] += share * (y + h * centroid(part)[1]);
        }
      }
      CHECK(area == Approx(signed_area(polygon)).epsilon(1e-13));
      CHECK(moment[0] == Approx(signed_area(polygon) * centroid(polygon)[0]).epsilon(1e-8));
      CHECK(moment[1] == Approx(signed_area(polygon) * centroid(polygon)[1]).epsilon(1e-8));
    }
  }
}

TEST_CASE("a square inside a polygon is all of it, exactly, and one outside is none") {
  CHECK(signed_area(clipped_to_unit_square(seen_from(kTriangle, 0.1, 0.1, 0.3))) == 1);
  CHECK(signed_area(clipped_to_unit_square(seen_from(kTriangle, 2, 2, 1))) == 0);
  CHECK(signed_area(clipped_to_unit_square(seen_from(kHorseshoe, 1, 1, 1))) == 0);
  CHECK(signed_area(clipped_to_unit_square(seen_from(kHorseshoe, 0, 1, 1))) == 1);
}

TEST_CASE("edges that cross, touch or fold back are found, and straight corners are none of these") {
  using Edges = std::pair<std::size_t, std::size_t>;
  CHECK_FALSE(crossing_edges(kTriangle));
  CHECK_FALSE(crossing_edges(kHorseshoe));
  CHECK_FALSE(crossing_edges({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));
  CHECK(crossing_edges({{0, 0}, {2, 2}, {2, 0}, {0, 2}}) == Edges{0, 2});                  // crosses
  CHECK(crossing_edges({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}) == Edges{0, 2});          // a corner on an edge
  CHECK(crossing_edges({{0, 0}, {4, 0}, {2, 0}, {2, 3}}) == Edges{0, 1});                  // folds back
  CHECK(crossing_edges({{0, 0}, {4, 0}, {4, 0}, {2, 3}}) == Edges{0, 1});                  // repeats a corner
  CHECK(crossing_edges({{0, 0}, {2, 1}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}) == Edges{0, 3});  // meets in a corner
}

TEST_CASE("the area that two polygons have in common is that of one clipped to the other") {
  Polygon star;
  for (int k = 0; k < 14; ++k) {
    const double angle = 2 * std::numbers::pi * k / 14 + 0.1, r = k % 2 == 0 ? 2.9 : 1.1;
    star.push_back({3.03 + r * std::cos(angle), 2.96 + r * std::sin(angle)});
  }
  for (const Polygon& polygon : {kTriangle, kHorseshoe, star, reversed(star)}) {
    for (const double x : {-0.5, 0.0, 1.0, 1.3, 2.7}) {
      const double y = 0.7 * x, h = 1.9;
      const Polygon square = {{x, y}, {x + h, y}, {x + h, y + h}, {x, y + h}};
      const double clipped = std::abs(signed_area(clipped_to_unit_square(seen_from(polygon, x, y, h)))) * h * h;
      for (const Polygon& other : {square, reversed(square)}) {
        CHECK(overlap_area(polygon, other) == Approx(clipped).margin(1e-12));
        CHECK(overlap_area(other, polygon) == Approx(clipped).margin(1e-12));
      }
    }
    CHECK(overlap_area(polygon, polygon) == Approx(std::abs(signed_area(polygon))));
    CHECK(overlap_area(polygon, reversed(polygon)) == Approx(std::abs(signed_area(polygon))));
  }
}

TEST_CASE("polygons side by side have nothing in common, wherever they lie") {
  const Polygon gap = {{1, 1}, {3, 1}, {3, 2}, {1, 2}};
  CHECK(std::abs(overlap_area(kHorseshoe, gap)) < 1e-15);
  const auto moved = [](Polygon polygon, double by) {
    for (PlanePoint& corner : polygon) corner = {corner[0] + by, corner[1] - by};
    return polygon;
  };
  CHECK(std::abs(overlap_area(moved(kHorseshoe, 1e6), moved(gap, 1e6))) < 1e-9);
  CHECK(overlap_area(kTriangle, moved(kTriangle, 5)) == 0);
}

TEST_CASE("the distance to a border is that to its nearest edge or corner") {
  CHECK(distance_to_border(kHorseshoe, {0.5, 1.5}) == Approx(0.5));
  CHECK(distance_to_border(kHorseshoe, {2, 1.5}) == Approx(0.5));
  CHECK(distance_to_border(kHorseshoe, {4, 0}) == Approx(1));
  CHECK(distance_to_border(kTriangle, {-3, -4}) == Approx(5));
}

TEST_CASE("the thinnest part of a polygon lies between edges that run against each other, not in a corner") {
  const Polygon blade = {{0, 0}, {0, -3}, {1, -3}, {1, 4}, {0, 4}, {0, 0.25}, {-2, 0.25}, {-2, 0}};
  for (const Polygon& either : {blade, reversed(blade)}) CHECK(thinnest_part(either) == Approx(0.25));
  CHECK(thinnest_part(Polygon{{0, 0}, {3, 0}, {3, 2}, {0, 2}}) == Approx(2));
  CHECK(std::isinf(thinnest_part(kTriangle)));
}

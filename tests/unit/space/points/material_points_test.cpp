// Points of boxes and polygons, cell by cell: their number, their places and their volumes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/polygon.hpp"
#include "largest.hpp"
#include "space/points/placed_bodies.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("a box has its points in every cell that it reaches, and its volume and mass") {
  BodySpec body = box({0.25, 0}, {2.5, 1});  // half of the first and of the second row's cells
  body.area = 3;
  const auto placed = place_body<2>(body, kGrid, 7, StressState::plane_strain);
  check_cells(placed.points);
  CHECK(placed.points.size() == 5 * 2 * 4);
  CHECK(placed.quadrature.degree == 1);
  CHECK(placed.quadrature.smallest_share == Approx(0.5));
  CHECK(volume_of(placed.points) == Approx(3 * 2.25 * 1).epsilon(1e-14));
  for (std::size_t p = 0; p < placed.points.size(); ++p)
    CHECK(placed.points.mass[p] == Approx(7 * placed.points.volume[p]));
  // In the first cell's half, from 0.25 to 0.5, quarters.
  CHECK(placed.points.position(0)[0] == Approx(0.3125));
  CHECK(placed.points.position(1)[0] == Approx(0.4375));
  CHECK(placed.points.position(2)[1] == Approx(0.5));
}

TEST_CASE("points along the two coordinates may differ in number") {
  BodySpec body = box({0, 0}, {4, 2});
  body.points_per_cell = {3, 1};
  const auto points = place(body);
  check_cells(points);
  CHECK(points.size() == 24 * 3);
  CHECK(points.position(1)[0] - points.position(0)[0] == Approx(0.5 / 3));
  CHECK(points.position(1)[1] == points.position(0)[1]);
}

TEST_CASE("the volumes of a polygon sum to its area to rounding, convex or not, either way round") {
  const std::vector<std::vector<std::vector<double>>> polygons = {
      {{0, 0}, {4, 0}, {0, 2}},
      {{0.13, 0.07}, {3.71, 0.3}, {3.2, 1.9}, {1.1, 1.77}},
      // not convex: a horseshoe whose gap is narrower than a cell, and an arrow with a notch
      {{0, 0}, {4, 0}, {4, 0.8}, {0.7, 0.8}, {0.7, 1.0}, {4, 1.0}, {4, 2}, {0, 2}},
      {{0.2, 0.2}, {2.1, 0.9}, {3.9, 0.1}, {2.2, 1.95}},
  };
  for (auto corners : polygons) {
    double area = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
      area += (a[0] * b[1] - b[0] * a[1]) / 2;
    }
    for (const Placement placement : {Placement::uniform, Placement::gauss, Placement::random}) {
      BodySpec body = polygon(corners);
      body.placement = placement;
      body.area = 0.5;
      const auto points = place(body);
      check_cells(points);
      CHECK(volume_of(points) == Approx(0.5 * std::abs(area)).epsilon(1e-12));
      CHECK(smallest_value(points.volume) >= 0);
    }
    std::reverse(corners.begin(), corners.end());
    CHECK(volume_of(place(polygon(corners))) == Approx(std::abs(area)).epsilon(1e-12));
  }
}

TEST_CASE("a polygon that is a box on grid lines is filled like the box") {
  const BodySpec as_polygon = polygon({{0.5, 0}, {3, 0}, {3, 2}, {0.5, 2}});
  const auto expected = place_body<2>(box({0.5, 0}, {3, 2}), kGrid, 1, StressState::plane_strain);
  const auto found = place_body<2>(as_polygon, kGrid, 1, StressState::plane_strain);
  CHECK(found.points.x == expected.points.x);
  CHECK(found.points.volume == expected.points.volume);
  CHECK(found.points.cell == expected.points.cell);
  CHECK(found.quadrature.degree == expected.quadrature.degree);
}

TEST_CASE("a cut cell keeps its points inside, or one at the centroid of its part, and slivers have none") {
  // Cells of 1/2 × 2/3. The first has three of its four points left of the slant, which leaves a corner of the second.
  BodySpec body = polygon({{0, 0}, {0.5, 0}, {0.5, 0.2}, {0.1, 2.0 / 3}, {0, 2.0 / 3}});
  const auto fitted = place(body);
  body.volumes = VolumeRule::equal;
  const auto equal = place(body);
  REQUIRE(equal.size() == 3);
  REQUIRE(fitted.size() == 3);
  const double cut = 0.5 * 0.4 * (2.0 / 3 - 0.2);
  for (std::size_t p = 0; p < 3; ++p) CHECK(equal.volume[p] == Approx((1.0 / 3 - cut) / 3));
  // Three points that are not in line have the area and its centre in one way.
  for (std::size_t d = 0; d < 2; ++d) {
    const double away = d == 0 ? 0.5 - 0.4 / 3 : 2.0 / 3 - (2.0 / 3 - 0.2) / 3;  // centroid of the corner cut off
    double moment = 0;
    for (std::size_t p = 0; p < 3; ++p) moment += fitted.volume[p] * fitted.x[d][p];
    CHECK(moment == Approx(1.0 / 3 * (d == 0 ? 0.25 : 1.0 / 3) - cut * away).epsilon(1e-12));
  }

  const auto corner = place(polygon({{0, 0}, {0.06, 0}, {0, 0.06}}));
  REQUIRE(corner.size() == 1);
  CHECK(corner.position(0)[0] == Approx(0.02));
  CHECK(corner.position(0)[1] == Approx(0.02));
  CHECK(corner.volume[0] == Approx(0.0018));

  // The second cell's share is 1e-8.
  const auto sliver = place(polygon({{0, 0}, {0.5 + 1e-4, 0}, {0.5, 1e-4}, {0.5, 2.0 / 3}, {0, 2.0 / 3}}));
  CHECK(sliver.size() == 4);
}

TEST_CASE("a polygon's cut cells are reported by the degree that they integrate, and Gauss points raise it") {
  BodySpec body = polygon({{0.3, 0.1}, {3.7, 0.4}, {2.1, 1.9}});
  const auto cells_below = [&](int degree) {
    return place_body<2>(body, kGrid, 1, StressState::plane_strain).quadrature.border_cells_below(degree);
  };
  body.points_per_cell = {4, 4};
  body.volumes = VolumeRule::equal;
  const int cut = cells_below(highest_cut_cell_degree + 1), equal = cells_below(1);
  int crossed = 0;  // by the triangle's border
  for (int number = 0; number < kGrid.cells(); ++number) {
    const auto [i, j] = kGrid.cell_at(number);
    const double x = 0.5 * i, y = 2.0 / 3 * j, w = 0.5, h = 2.0 / 3;
    const double inside =
        overlap_area({{0.3, 0.1}, {3.7, 0.4}, {2.1, 1.9}}, {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}});
    crossed += inside > 1e-9 && inside < w * h - 1e-9 ? 1 : 0;
  }
  CHECK(cut == crossed);
  CHECK(equal > cut / 2);
  body.volumes = VolumeRule::consistent;
  CHECK(cells_below(1) < equal);
  CHECK(cells_below(highest_cut_cell_degree + 1) == cut);
  body.placement = Placement::gauss;
  CHECK(cells_below(4) == 0);
  body.points_per_cell = {3, 3};
  CHECK(cells_below(2) == 0);
  CHECK(cells_below(4) > 0);
  // Moments of the whole body, in its cells of both kinds.
  const auto points = place(body);
  double xy = 0;
  for (std::size_t p = 0; p < points.size(); ++p) xy += points.volume[p] * points.x[0][p] * points.x[1][p];
  const auto& c = body.polygon;
  double twice_area = 0, sum_x = 0, sum_y = 0, sum_xy = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = c[k], &b = c[(k + 1) % 3];
    twice_area += a[0] * b[1] - b[0] * a[1];
    sum_x += a[0], sum_y += a[1], sum_xy += a[0] * a[1];
  }
  CHECK(xy == Approx(twice_area / 24 * (sum_x * sum_y + sum_xy)).epsilon(1e-12));
}

TEST_CASE("the points of a full circle sum to the exact volume of a cylinder and of a pipe") {
  const double pi = std::numbers::pi;
  for (const double inner : {0.0, 0.75}) {
    BodySpec body = box({inner, 0}, {3, 2});
    body.points_per_cell = {3, 1};
    const auto points = place(body, StressState::axisymmetric, 5);
    CHECK(volume_of(points) == Approx(pi * (9 - inner * inner) * 2).epsilon(1e-13));
    // The outer two of a cell's three points have the same area, 3/8 of it.
    CHECK(points.volume[2] / points.volume[0] == Approx(points.position(2)[0] / points.position(0)[0]));
    CHECK(points.mass[0] == Approx(5 * points.volume[0]));
  }
  // A cone: by the pattern's points that lie inside to the error of the midpoint rule, by Gauss points exactly.
  BodySpec cone = polygon({{0, 0}, {4, 0}, {0, 2}});
  CHECK(volume_of(place(cone, StressState::axisymmetric)) == Approx(pi * 16 * 2 / 3).epsilon(0.03));
  cone.placement = Placement::gauss;
  CHECK(volume_of(place(cone, StressState::axisymmetric)) == Approx(pi * 16 * 2 / 3).epsilon(1e-12));
}

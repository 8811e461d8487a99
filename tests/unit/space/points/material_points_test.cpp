#include "space/points/material_points.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "geometry/polygon.hpp"
#include "largest.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

// [0, 4] × [0, 2] in 8 × 3 cells.
const Grid<2> kGrid{Axis::uniform(0, 4, 8), Axis::uniform(0, 2, 3)};

BodySpec box(std::vector<double> min, std::vector<double> max) {
  BodySpec body;
  body.min = std::move(min);
  body.max = std::move(max);
  body.points_per_cell = {2, 2};
  return body;
}

BodySpec polygon(std::vector<std::vector<double>> corners) {
  BodySpec body = box({4, 2}, {0, 0});
  std::vector<double> low = body.min, high = body.max;
  for (const auto& corner : corners) {
    for (std::size_t d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], corner[d]);
      high[d] = std::max(high[d], corner[d]);
    }
  }
  body.min = low;
  body.max = high;
  body.polygon = std::move(corners);
  return body;
}

BodySpec from_file(const std::filesystem::path& file) {
  BodySpec body;
  body.file = file;
  return body;
}

MaterialPoints<2> place(const BodySpec& body, StressState state = StressState::plane_strain, double density = 1) {
  return place_body<2>(body, kGrid, density, state).points;
}

double volume_of(const MaterialPoints<2>& points) {
  return std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
}

/// Points lie in the cells that list them, cells ascend, and none is empty.
void check_cells(const MaterialPoints<2>& points) {
  REQUIRE(points.cell_begin.size() == points.cell.size() + 1);
  REQUIRE(static_cast<std::size_t>(points.cell_begin.back()) == points.size());
  CHECK(std::adjacent_find(points.cell.begin(), points.cell.end(), std::greater_equal<>()) == points.cell.end());
  for (std::size_t k = 0; k < points.cell.size(); ++k) {
    CHECK(points.cell_begin[k] < points.cell_begin[k + 1]);
    for (int p = points.cell_begin[k]; p < points.cell_begin[k + 1]; ++p)
      CHECK(kGrid.cell_number(kGrid.cell_of(points.position(static_cast<std::size_t>(p)))) == points.cell[k]);
  }
}

std::vector<std::string> problems_of(const std::filesystem::path& file) {
  std::vector<std::string> found;
  try {
    place(from_file(file));
  } catch (const SceneError& error) {
    for (const Mistake& problem : error.problems())
      found.push_back(fmt::format("{}:{} {}", problem.where.line, problem.where.column, problem.message));
  }
  return found;
}

}  // namespace

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

TEST_CASE("jitter moves every point by at most its share of half the spacing, so that each stays in its cell") {
  for (const Placement placement : {Placement::uniform, Placement::gauss}) {
    BodySpec body = box({0, 0}, {4, 2});
    body.placement = placement;
    body.points_per_cell = {3, 2};
    const auto regular = place(body);
    body.jitter = 0.999;
    const auto jittered = place(body);
    check_cells(jittered);
    CHECK(volume_of(jittered) == Approx(8).epsilon(1e-12));
    Largest farthest;
    for (std::size_t p = 0; p < regular.size(); ++p)
      farthest.take_magnitude(jittered.position(p)[0] - regular.position(p)[0]);
    // Half the spacing; of three Gauss points the middle one has more room, 0.387 of half a cell.
    const double room = placement == Placement::uniform ? 0.5 / 3 / 2 : 0.25 * std::sqrt(0.6) / 2;
    CHECK(farthest.value() < room);
    CHECK(farthest.value() > 0.95 * room);
    // Neighbours keep their order.
    for (std::size_t p = 0; p + 1 < jittered.size(); ++p)
      if (p % 3 != 2) CHECK(jittered.position(p)[0] < jittered.position(p + 1)[0]);

    body.jitter = 0.1;
    const auto little = place(body);
    for (std::size_t p = 0; p < regular.size(); ++p)
      CHECK(std::abs(little.position(p)[0] - regular.position(p)[0]) <= 0.1 * room);
  }
}

TEST_CASE("jittered and random points are the same for the same seed, and others for another") {
  for (const bool random : {true, false}) {
    BodySpec body = box({0, 0}, {4, 2});
    if (random) body.placement = Placement::random;
    if (!random) body.jitter = 0.5;
    const auto first = place(body), again = place(body);
    body.seed = 2;
    const auto other = place(body);
    CHECK(first.x == again.x);
    CHECK(first.volume == again.volume);
    CHECK_FALSE(first.x[0] == other.x[0]);
    CHECK_FALSE(first.x[1] == other.x[1]);
  }
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

TEST_CASE("points written to a file and read back are the same to the bit, whatever the order of lines and columns") {
  BodySpec body = box({0, 0}, {4, 2});
  body.placement = Placement::random;
  body.volumes = VolumeRule::equal;
  const auto written = place(body, StressState::plane_strain, 3);
  const TemporaryFolder folder;
  std::string text = "# random points\nvolume, y, x\n\n";
  for (std::size_t p = written.size(); p-- > 0;)
    text +=
        fmt::format("{:.17g},{:.17g},\t{:.17g} # point {}\r\n", written.volume[p], written.x[1][p], written.x[0][p], p);
  const auto placed = place_body<2>(from_file(folder.write("points.csv", text)), kGrid, 3, StressState::axisymmetric);
  const auto& read = placed.points;
  check_cells(read);
  CHECK(read.cell == written.cell);
  CHECK(read.cell_begin == written.cell_begin);
  // In a cell they are in the file's order, here the other way round.
  for (std::size_t k = 0; k < read.cell.size(); ++k) {
    for (int p = read.cell_begin[k]; p < read.cell_begin[k + 1]; ++p) {
      const auto here = static_cast<std::size_t>(p);
      const auto there = static_cast<std::size_t>(read.cell_begin[k] + read.cell_begin[k + 1] - 1 - p);
      CHECK(read.position(here) == written.position(there));
      CHECK(read.volume[here] == written.volume[there]);
      CHECK(read.mass[here] == written.mass[there]);
    }
  }
}

TEST_CASE("points on a line come from a file in order of place") {
  const TemporaryFolder folder;
  const Grid<1> line{Axis::uniform(0, 4, 2)};
  const auto file = folder.write("points.csv", "x,volume\n3,1\n1.5,2\n0.5,3\n2,4\n");
  const auto points = place_body<1>(from_file(file), line, 1, StressState::uniaxial_stress).points;
  CHECK(points.x[0] == std::vector{0.5, 1.5, 2.0, 3.0});
  CHECK(points.volume == std::vector{3.0, 2.0, 4.0, 1.0});
  CHECK(points.cell_begin == std::vector{0, 2, 4});
}

TEST_CASE("what is wrong with a file of points is said with its line and column, all at once") {
  using Found = std::vector<std::string>;
  const TemporaryFolder folder;
  const auto found_in = [&](const std::string& text) { return problems_of(folder.write("points.csv", text)); };
  CHECK(found_in("x,y,volume\n1,1,1\n").empty());
  CHECK(found_in("\xEF\xBB\xBFx,y,volume\n1,1,+1e0\n").empty());  // a byte order mark
  CHECK(problems_of(folder.path() / "none.csv") == Found{"0:0 there is no such file"});
  CHECK(problems_of(folder.path()) == Found{"0:0 is not a file of points"});
  CHECK(problems_of("/dev/zero") == Found{"0:0 is not a file of points"});
  CHECK(found_in("") == Found{"0:0 is empty: expected a line with the columns x, y, volume"});
  CHECK(found_in("x,y,volume\n# none\n") == Found{"0:0 holds no points"});
  CHECK(found_in("x,y\n1,1\n") == Found{"1:1 the column 'volume' is missing; expected x, y, volume"});
  CHECK(found_in("x,volume,z\n1,1,1\n") == Found{"1:10 unknown column 'z'; expected one of x, y, volume"});
  CHECK(found_in("x,y,volme\n1,1,1\n") == Found{"1:5 unknown column 'volme'; did you mean 'volume'?"});
  CHECK(found_in("x,y,volume,x\n1,1,1,1\n") == Found{"1:12 the column 'x' is there already"});
  CHECK(found_in("x,y,volume\n1,1\n1,1,1,1\n1,,1\n1,1e999,1\n nan,1,0\n5,1,-1\n") ==
        Found{"2:1 expected 3 values, found 2", "3:1 expected 3 values, found 4",
              "4:3 y: expected a finite number, found ''", "5:3 y: expected a finite number, found '1e999'",
              "6:2 x: expected a finite number, found 'nan'", "6:8 volume: must be greater than 0, not 0",
              "7:1 x = 5 lies outside the grid, 0 to 4", "7:5 volume: must be greater than 0, not -1"});

  std::string wrong = "x,y,volume\n";
  for (int k = 0; k < 100; ++k) wrong += "a;b;c\n";
  const Found many = found_in(wrong);
  REQUIRE(many.size() == 21);
  CHECK(many.back() == "22:1 from here on, more is wrong than is listed");
}

// The material points of bodies in space that are no boxes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "geometry/polygon.hpp"
#include "geometry/quadric_solid.hpp"
#include "largest.hpp"
#include "scene/body_solid.hpp"
#include "space/points/material_points.hpp"
#include "space/points/solid_cell_rule.hpp"
#include "temporary_folder.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using stillpoint::test::TemporaryFolder;

namespace {

constexpr double pi = std::numbers::pi;

/// [0, 4]³ in n³ cells.
Grid<3> cube(int n) { return {Axis::uniform(0, 4, n), Axis::uniform(0, 4, n), Axis::uniform(0, 4, n)}; }

/// Of the whole grid; 8 points in a cell.
BodySpec whole() {
  BodySpec body;
  body.min = {0, 0, 0};
  body.max = {4, 4, 4};
  body.points_per_cell = {2, 2, 2};
  return body;
}
BodySpec cut_to(BodySpec body) {
  const SpaceBox part = in_common(solid_of(body)->bounds(), box_of(body));
  body.min = std::vector(part.low.begin(), part.low.end());
  body.max = std::vector(part.high.begin(), part.high.end());
  return body;
}
BodySpec sphere(double radius, double inner = 0, std::vector<double> centre = {2.1, 1.95, 2.03}) {
  BodySpec body = whole();
  body.sphere = std::move(centre);
  body.radius = radius;
  body.inner_radius = inner;
  return cut_to(body);
}
BodySpec cylinder(std::vector<std::vector<double>> ends, double radius, double inner = 0) {
  BodySpec body = whole();
  body.cylinder = std::move(ends);
  body.radius = radius;
  body.inner_radius = inner;
  return cut_to(body);
}
BodySpec prism(int axis, double from, double to) {
  BodySpec body = whole();
  body.polygon = {{0.3, 0.4}, {3.5, 0.7}, {1.7, 1.6}, {2.9, 3.8}, {0.6, 3.1}};
  body.axis = axis;
  std::vector<double> low = body.min, high = body.max;
  low.at(static_cast<std::size_t>(axis)) = from;
  high.at(static_cast<std::size_t>(axis)) = to;
  body.min = low;
  body.max = high;
  return cut_to(body);
}
double area_of_polygon(const BodySpec& body) {
  Polygon polygon;
  for (const auto& corner : body.polygon) polygon.push_back({corner[0], corner[1]});
  return std::abs(signed_area(polygon));
}
double volume_of(const MaterialPoints<3>& points) {
  return std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
}
PlacedBody<3> placed_in(const BodySpec& body, int n) { return place_body<3>(body, cube(n), 7, StressState::space); }
MaterialPoints<3> place(const BodySpec& body, int n) { return placed_in(body, n).points; }

/// Points lie inside, in the cells that list them, which ascend, and have volumes and masses.
void check_points(const MaterialPoints<3>& points, const BodySpec& body, int n) {
  const Grid<3> grid = cube(n);
  const auto solid = solid_of(body);
  REQUIRE(points.size() > 0);
  REQUIRE(points.cell_begin.size() == points.cell.size() + 1);
  CHECK(std::adjacent_find(points.cell.begin(), points.cell.end(), std::greater_equal<>()) == points.cell.end());
  int outside = 0, elsewhere = 0;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    CHECK(points.begin(k) < points.end(k));
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      outside += solid->contains(points.position(p)) ? 0 : 1;
      elsewhere += grid.cell_number(grid.cell_of(points.position(p))) == points.cell[k] ? 0 : 1;
      CHECK(points.mass[p] == Approx(7 * points.volume[p]));
    }
  }
  CHECK(outside == 0);
  CHECK(elsewhere == 0);
  CHECK(smallest_value(points.volume) >= 0);
}

}  // namespace

TEST_CASE("a sphere has its points inside, in their cells, and its volume to 1e-4 on 8 cells across a radius") {
  const double V = 4 * pi / 3 * std::pow(1.6, 3);
  for (const Placement placement : {Placement::uniform, Placement::gauss, Placement::random}) {
    for (const VolumeRule volumes : {VolumeRule::equal, VolumeRule::consistent}) {
      BodySpec body = sphere(1.6);
      body.placement = placement;
      body.volumes = volumes;
      const auto points = place(body, 20);
      check_points(points, body, 20);
      CHECK(volume_of(points) == Approx(V).epsilon(1e-4));
    }
  }
}

TEST_CASE(
    "the volume of a sphere comes nearer as cells get smaller: what slivers leave out is below 1e-6 of a cell each") {
  const double V = 4 * pi / 3 * std::pow(1.6, 3);
  for (const int n : {5, 10, 20, 40}) {
    CAPTURE(n);
    const double cell = std::pow(4.0 / n, 3), cut_cells = 4 * pi * std::pow(1.6 / 4 * n, 2);
    CHECK(std::abs(volume_of(place(sphere(1.6), n)) - V) < 1e-6 * cell * cut_cells + 1e-6 * V);
  }
}

// The mean of x² by the points of each cell is that of its part, but for the cells with too few points for degree 2.
TEST_CASE("the second moment of a sphere's points converges at order 2") {
  const double exact = 4 * pi / 15 * std::pow(1.6, 5);
  const auto error = [&](int n) {
    const auto points = place(sphere(1.6), n);
    double sum = 0;
    for (std::size_t p = 0; p < points.size(); ++p) sum += points.volume[p] * std::pow(points.x[0][p] - 2.1, 2);
    return std::abs(sum / exact - 1);
  };
  const double coarse = error(10), fine = error(40);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) / 2 > 1.8);
}

TEST_CASE("a hollow sphere, an eighth of it and cylinders along any axis have their volumes") {
  CHECK(volume_of(place(sphere(1.8, 1), 16)) == Approx(4 * pi / 3 * (std::pow(1.8, 3) - 1)).epsilon(1e-5));
  CHECK(volume_of(place(sphere(3.2, 1.6, {0, 0, 0}), 16)) ==
        Approx(pi / 6 * (std::pow(3.2, 3) - std::pow(1.6, 3))).epsilon(1e-5));
  const std::vector<std::vector<std::vector<double>>> ends = {
      {{0.3, 2, 2}, {3.6, 2, 2}}, {{2, 0.3, 2}, {2, 3.6, 2}}, {{2, 2, 0.3}, {2, 2, 3.6}}};
  for (const auto& axis : ends)
    CHECK(volume_of(place(cylinder(axis, 1.5, 0.4), 11)) == Approx(pi * (2.25 - 0.16) * 3.3).epsilon(1e-5));
  const BodySpec askew = cylinder({{1.5, 1.4, 1.2}, {2.5, 2.6, 2.9}}, 0.9);
  const auto points = place(askew, 13);
  check_points(points, askew, 13);
  CHECK(volume_of(points) == Approx(pi * 0.81 * std::sqrt(1 + 1.44 + 2.89)).epsilon(1e-5));
}

TEST_CASE("a prism has the area of its polygon times its length but for slivers, along any axis") {
  for (const int axis : {0, 1, 2}) {
    const BodySpec body = prism(axis, 0.7, 3.1);
    const auto points = place(body, 9);
    CAPTURE(axis);
    check_points(points, body, 9);
    CHECK(volume_of(points) == Approx(area_of_polygon(body) * 2.4).epsilon(1e-9));
  }
}

TEST_CASE("a prism that is a box on grid lines, and a box of triangles, are filled like the box") {
  BodySpec box = whole();
  box.min = {1, 1, 0.5};
  box.max = {2.5, 3, 2};
  BodySpec drawn = box;
  drawn.polygon = {{1, 1}, {2.5, 1}, {2.5, 3}, {1, 3}};
  const TemporaryFolder folder;
  BodySpec surface = box;
  surface.stl = folder.write("box.stl", binary_stl(box_of_triangles({1, 1, 0.5}, {2.5, 3, 2})));
  const auto expected = placed_in(box, 8);
  for (const BodySpec& body : {drawn, surface}) {
    const auto found = placed_in(body, 8);
    REQUIRE(found.points.size() == expected.points.size());
    CHECK(found.points.cell == expected.points.cell);
    for (std::size_t d = 0; d < 3; ++d) CHECK(largest_difference(found.points.x[d], expected.points.x[d]) < 1e-12);
    CHECK(largest_difference(found.points.volume, expected.points.volume) < 1e-14);
    CHECK(found.covered.size() == expected.covered.size());
  }
}

TEST_CASE("a sphere of triangles is filled as the sphere is, to what the facets leave out") {
  // An octahedron whose faces are divided and put onto the sphere.
  std::vector<Facet> triangles = octahedron();
  const auto middle = [](const SpacePoint& a, const SpacePoint& b) {
    SpacePoint x;
    for (std::size_t d = 0; d < 3; ++d) x[d] = a[d] + b[d];
    const double length = std::hypot(x[0], x[1], x[2]);
    for (double& coordinate : x) coordinate /= length;
    return x;
  };
  for (int level = 0; level < 5; ++level) {
    std::vector<Facet> finer;
    for (const auto& [a, b, c] : triangles) {
      const SpacePoint ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = finer;
  }
  const double V = std::abs(signed_volume(triangles)) * 8;
  for (Facet& triangle : triangles)
    for (SpacePoint& x : triangle)
      for (double& coordinate : x) coordinate = 2 + 2 * 0.999 * coordinate;
  const TemporaryFolder folder;
  BodySpec body = whole();
  body.stl = folder.write("sphere.stl", binary_stl(triangles));
  for (const Placement placement : {Placement::uniform, Placement::gauss}) {
    body.placement = placement;
    const auto placed = placed_in(cut_to(body), 12);
    check_points(placed.points, body, 12);
    CHECK(volume_of(placed.points) == Approx(V * std::pow(0.999, 3)).epsilon(1e-5));
  }
}

TEST_CASE("the part of a cell that a solid cuts has the same bits wherever memory lies") {
  const QuadricSolid sphere = QuadricSolid::sphere({0, 0, 0}, 1, 0);
  const SpaceBox box{{0.3, 0.2, 0.4}, {0.8, 0.7, 0.9}};
  const CellPart first(sphere, box, 8);
  for (std::size_t k = 1; k < 16; ++k) {
    std::vector<std::vector<double>> in_between;  // of all sizes, so that what comes next is aligned in all ways
    for (std::size_t n = 1; n < 200; ++n) in_between.emplace_back(n + 2 * k);
    for (std::size_t n = k % 4; n < in_between.size(); n += 1 + k % 3) std::vector<double>().swap(in_between[n]);
    const CellPart part(sphere, box, 8);
    CHECK(part.volume() == first.volume());
    CHECK(part.gauss_points().share == first.gauss_points().share);
  }
}

TEST_CASE("fitted shares of a cell that a solid cuts are not negative, sum to one and integrate what they say") {
  const QuadricSolid sphere = QuadricSolid::sphere({0, 0, 0}, 1, 0);
  const SpaceBox box{{0.3, 0.2, 0.4}, {0.8, 0.7, 0.9}};
  int fitted_higher = 0;
  for (const int n : {2, 3, 4}) {
    std::vector<SpacePoint> inside;
    for (int k = 0; k < n * n * n; ++k) {
      SpacePoint x;
      for (std::size_t d = 0, number = static_cast<std::size_t>(k); d < 3; ++d, number /= static_cast<std::size_t>(n))
        x[d] = box.low[d] + 0.5 * (static_cast<double>(number % static_cast<std::size_t>(n)) + 0.5) / n;
      if (sphere.contains(x)) inside.push_back(x);
    }
    const CellPart part(sphere, box, static_cast<std::size_t>(n * n * n));
    const SolidCellRule equal = part.equal_shares(inside), fitted = part.fitted_shares(inside),
                        gauss = part.gauss_points();
    CHECK(gauss.x.size() <= static_cast<std::size_t>(n * n * n));
    CHECK(gauss.degree == 2 * n - 3);  // with no more moments than points: 4 for 8, 20 for 27, 56 for 64
    fitted_higher += fitted.degree > equal.degree ? 1 : 0;
    const SpaceRule exact = sphere.rule(box, 5);
    const double V = std::accumulate(exact.weight.begin(), exact.weight.end(), 0.0);
    for (const SolidCellRule* rule : {&equal, &fitted, &gauss}) {
      CAPTURE(n, rule->degree);
      CHECK(std::accumulate(rule->share.begin(), rule->share.end(), 0.0) == Approx(1).epsilon(1e-10));
      CHECK(smallest_value(rule->share) > 0);
      for (const SpacePoint& x : rule->x) CHECK(sphere.contains(x));
      for (int a = 0; a <= rule->degree; ++a) {
        for (int b = 0; a + b <= rule->degree; ++b) {
          const int c = rule->degree - a - b;
          const auto q = [&](const SpacePoint& x) { return std::pow(x[0], a) * std::pow(x[1], b) * std::pow(x[2], c); };
          double sum = 0, mean = 0;
          for (std::size_t p = 0; p < rule->x.size(); ++p) sum += rule->share[p] * q(rule->x[p]);
          for (std::size_t p = 0; p < exact.x.size(); ++p) mean += exact.weight[p] / V * q(exact.x[p]);
          CHECK(sum == Approx(mean).epsilon(1e-6));
        }
      }
    }
  }
  CHECK(fitted_higher == 3);
}

TEST_CASE("points of a file in space are taken with their volumes, sorted by cell") {
  const TemporaryFolder folder;
  BodySpec body;
  body.file = folder.write("points.csv", "z,x,y,volume\n3.5,0.5,0.5,0.25\n0.5,1.5,2.5,0.5\n0.5,0.5,0.5,0.75\n");
  const auto points = place(body, 4);
  REQUIRE(points.size() == 3);
  CHECK(points.cell == std::vector<int>{0, 1 + 4 * 2, 16 * 3});
  CHECK(points.volume == std::vector<double>{0.75, 0.5, 0.25});
  CHECK(points.position(1) == Point<3>{1.5, 2.5, 0.5});
  CHECK(points.mass[0] == Approx(7 * 0.75));
}

// What solids say of themselves: volumes, moments, and which positions lie inside.
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "geometry/prism.hpp"
#include "geometry/quadric_solid.hpp"
#include "geometry/triangle_solid.hpp"
#include "largest.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using std::numbers::pi;

namespace {

/// ∫ q dV over all cells of a box around the solid that is divided into n³.
double integral(const Solid& solid, int n, int degree, const std::function<double(const SpacePoint&)>& q) {
  SpaceBox around = solid.bounds();
  for (std::size_t d = 0; d < 3; ++d) {  // so that no line of the grid is one of symmetry
    around.low[d] -= 0.013;
    around.high[d] += 0.027;
  }
  double sum = 0;
  for (int number = 0; number < n * n * n; ++number) {
    const std::array at{number % n, number / n % n, number / n / n};
    SpaceBox cell;
    for (std::size_t d = 0; d < 3; ++d) {
      const double h = (around.high[d] - around.low[d]) / n;
      cell.low[d] = around.low[d] + h * at[d];
      cell.high[d] = cell.low[d] + h;
    }
    const SpaceRule rule = solid.rule(cell, degree);
    double here = 0, volume = 0;
    for (std::size_t p = 0; p < rule.x.size(); ++p) {
      here += rule.weight[p] * q(rule.x[p]);
      volume += rule.weight[p];
    }
    sum += here;
    const Solid::Part part = solid.part_of(cell);
    if (part == Solid::Part::none) CHECK(std::abs(volume) < 1e-12 * cell.volume());
    if (part == Solid::Part::all) CHECK(volume == Approx(cell.volume()).epsilon(1e-12));
  }
  return sum;
}

double volume(const Solid& solid, int n) {
  return integral(solid, n, 0, [](const SpacePoint&) { return 1.0; });
}

}  // namespace

TEST_CASE("a sphere and a cylinder, solid or hollow, askew or not, have their volumes to 1e-6 on any grid") {
  const double sphere = 4 * pi / 3;
  for (const int n : {1, 3, 8}) {
    CAPTURE(n);
    CHECK(volume(QuadricSolid::sphere({0.1, 0.2, 0.3}, 1, 0), n) == Approx(sphere).epsilon(1e-6));
    CHECK(volume(QuadricSolid::sphere({0.1, 0.2, 0.3}, 1, 0.5), n) == Approx(sphere * 7 / 8).epsilon(1e-6));
    CHECK(volume(QuadricSolid::cylinder({1, 0, 0}, {1, 0, 2}, 0.7, 0), n) == Approx(pi * 0.49 * 2).epsilon(1e-6));
    CHECK(volume(QuadricSolid::cylinder({0, 0, 0}, {1, 2, 2}, 1, 0.4), n) == Approx(pi * 0.84 * 3).epsilon(1e-6));
  }
}

TEST_CASE("a cut at a plane of coordinates leaves a sphere's eighth, and a slice its volume") {
  const QuadricSolid sphere = QuadricSolid::sphere({0, 0, 0}, 1, 0);
  const auto in = [&](const SpaceBox& box) {
    double sum = 0;
    for (const double weight : sphere.rule(box, 0).weight) sum += weight;
    return sum;
  };
  CHECK(in({{0, 0, 0}, {1, 1, 1}}) == Approx(pi / 6).epsilon(1e-7));
  CHECK(in({{-2, 0.5, -2}, {2, 2, 2}}) == Approx(pi * 0.25 * (3 - 0.5) / 3).epsilon(1e-5));  // π h² (3 R − h)/3
}

TEST_CASE("the second moment of a sphere about a plane through its centre is 4 pi R^5/15") {
  const QuadricSolid sphere = QuadricSolid::sphere({0.5, -1, 2}, 2, 0);
  for (const int n : {1, 5}) {
    for (std::size_t d = 0; d < 3; ++d) {
      const double centre = std::array{0.5, -1.0, 2.0}[d];
      CHECK(integral(sphere, n, 2, [&](const SpacePoint& x) { return (x[d] - centre) * (x[d] - centre); }) ==
            Approx(4 * pi * 32 / 15).epsilon(1e-6));
    }
  }
}

TEST_CASE("a prism along any axis has its volume and first moments but for rounding") {
  const Polygon notched = {{0, 0}, {1, 0}, {0.3, 0.4}, {0, 1}};
  const PlanePoint middle = centroid(notched);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Prism prism(notched, axis, 0.2, 1.7);
    const std::size_t i = across(axis)[0], j = across(axis)[1];
    for (const int n : {1, 4, 7}) {
      CAPTURE(axis, n);
      const double V = 0.35 * 1.5;
      CHECK(volume(prism, n) == Approx(V).epsilon(1e-12));
      CHECK(integral(prism, n, 1, [&](const SpacePoint& x) { return x[axis]; }) == Approx(V * 0.95).epsilon(1e-12));
      CHECK(integral(prism, n, 1, [&](const SpacePoint& x) { return x[i]; }) == Approx(V * middle[0]).epsilon(1e-12));
      CHECK(integral(prism, n, 1, [&](const SpacePoint& x) { return x[j]; }) == Approx(V * middle[1]).epsilon(1e-12));
    }
  }
}

TEST_CASE("a surface of triangles, wound either way, encloses its volume and moments but for rounding") {
  std::vector<Facet> triangles = octahedron();  // |x| + |y| + |z| ≤ 1
  for (int way = 0; way < 2; ++way) {
    const TriangleSolid solid(triangles);
    for (const int n : {1, 2, 5}) {
      CAPTURE(way, n);
      CHECK(volume(solid, n) == Approx(4.0 / 3).epsilon(1e-12));
      for (std::size_t d = 0; d < 3; ++d)
        CHECK(integral(solid, n, 2, [d](const SpacePoint& x) { return x[d] * x[d]; }) ==
              Approx(2.0 / 15).epsilon(1e-12));
    }
    for (Facet& triangle : triangles) std::swap(triangle[0], triangle[1]);
  }
}

TEST_CASE("a box of triangles whose faces lie on the box asked for has all of it, once") {
  const TriangleSolid solid(box_of_triangles({0, 0, 0}, {2, 1, 1}));
  for (const SpaceBox& box : {SpaceBox{{0, 0, 0}, {1, 1, 1}}, SpaceBox{{1, 0, 0}, {2, 1, 1}}}) {
    double sum = 0;
    for (const double weight : solid.rule(box, 1).weight) sum += weight;
    CHECK(sum == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("lines through edges and corners of triangles are counted right") {
  const TriangleSolid solid(octahedron());
  // All of the lattice's lines along x go through edges or corners, or along faces' projections.
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      for (int k = -4; k <= 4; ++k) {
        const SpacePoint x{i / 3.0, j / 4.0, k / 4.0};
        const double distance = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]) - 1;
        CAPTURE(x);
        if (std::abs(distance) > 1e-9) CHECK(solid.contains(x) == (distance < 0));
      }
    }
  }
}

TEST_CASE("a solid contains what its rules say that it does, by chance's positions") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  const TriangleSolid octahedral(octahedron());
  const QuadricSolid cylinder = QuadricSolid::cylinder({0, -1, 0}, {0, 1, 0}, 0.8, 0.3);
  for (const auto& [solid, V] : {std::pair<const Solid*, double>{&octahedral, 4.0 / 3}, {&cylinder, 2 * pi * 0.55}}) {
    int inside = 0;
    constexpr int n = 40'000;
    for (int k = 0; k < n; ++k)
      inside += solid->contains({coordinate(random), coordinate(random), coordinate(random)}) ? 1 : 0;
    CHECK(inside * std::pow(2.4, 3) / n == Approx(V).epsilon(0.03));
  }
}

TEST_CASE("a surface with a triangle missing, or wound the other way, has an edge that is open") {
  CHECK_FALSE(open_edge(octahedron()));
  std::vector<Facet> triangles = octahedron();
  triangles.pop_back();
  CHECK(open_edge(triangles));
  triangles = octahedron();
  std::swap(triangles[3][0], triangles[3][1]);
  CHECK(open_edge(triangles));
}

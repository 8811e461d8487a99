// Rigid surfaces of triangles, above all where the nearest position is on an edge or a corner.
#include "geometry/triangle_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/polygon.hpp"
#include "geometry/simple_shapes.hpp"
#include "shape_checks.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace {

const SpacePoint kLow{-0.6, -0.5, -0.4}, kHigh{0.3, 0.7, 0.8};

SpacePoint point_of(const Vector3d& x) { return {x[0], x[1], x[2]}; }

void check_against_solid(const std::vector<Facet>& triangles, double half_side) {
  const TriangleSolid solid(triangles);
  check_shape(*triangle_shape(triangles), half_side, [&](const Vector3d& x) { return solid.contains(point_of(x)); });
}

/// A sphere of triangles: the octahedron with its edges halved this often, and the corners moved onto the sphere.
std::vector<Facet> sphere_of_triangles(int halvings) {
  std::vector<Facet> triangles = octahedron();
  const auto between = [](const SpacePoint& a, const SpacePoint& b) {
    return point_of((Vector3d(a.data()) + Vector3d(b.data())).normalized());
  };
  for (; halvings > 0; --halvings) {
    std::vector<Facet> finer;
    for (const auto& [a, b, c] : triangles) {
      const SpacePoint ab = between(a, b), bc = between(b, c), ca = between(c, a);
      for (const Facet& part : {Facet{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(part);
    }
    triangles = finer;
  }
  return triangles;
}

/// The L of three cubes whose reflex edge is the z axis, from z = −1 to 0.
std::vector<Facet> bracket() {
  std::vector<Facet> triangles;
  const Polygon corners = {{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
  const auto at = [&](std::size_t k, double z) { return SpacePoint{corners[k % 6][0], corners[k % 6][1], z}; };
  for (std::size_t k = 0; k < 6; ++k) {
    triangles.push_back(Facet{at(k, -1), at(k + 1, -1), at(k + 1, 0)});
    triangles.push_back(Facet{at(k, -1), at(k + 1, 0), at(k, 0)});
  }
  for (const std::size_t k : {4U, 5U, 6U, 7U}) {  // fans about the reflex corner
    triangles.push_back(Facet{at(3, 0), at(k, 0), at(k + 1, 0)});
    triangles.push_back(Facet{at(3, -1), at(k + 1, -1), at(k, -1)});
  }
  return triangles;
}

}  // namespace

TEST_CASE("a box of triangles is the box, inside and outside, at its faces, edges, corners and diagonals") {
  const Vector3d low(kLow.data()), sides = Vector3d(kHigh.data()) - low;
  const auto shape = triangle_shape(box_of_triangles(kLow, kHigh)), exact = box<3>(low, low + sides);
  Largest off, normal_off, hessian_off;
  const auto compare_at = [&](const Vector3d& x, bool at_end_of_edge) {
    const Nearest<3> here = shape->nearest(x), there = exact->nearest(x);
    off.take_magnitude(here.distance - there.distance);
    if (there.distance < 1e-9) return;  // inside, several faces may be equally near
    normal_off.take((here.normal - there.normal).norm());
    if (!at_end_of_edge) hessian_off.take((here.hessian - there.hessian).norm());  // which jumps there
  };
  for (const Vector3d& x : positions_by_chance<3>(500, 1.5)) compare_at(x, false);
  const std::array shares{-0.5, 0.0, 0.25, 0.5, 0.75, 1.0, 1.5};
  for (const double i : shares)
    for (const double j : shares)
      for (const double k : shares)
        compare_at(low + Vector3d(i, j, k).cwiseProduct(sides),
                   std::ranges::any_of(std::array{i, j, k}, [](double share) { return share == 0 || share == 1; }));
  CHECK(off.value() < 1e-14);
  CHECK(normal_off.value() < 1e-13);
  CHECK(hessian_off.value() < 1e-12);
}

TEST_CASE("surfaces of triangles, with reflex edges too, have the signed distance of their solids") {
  check_against_solid(octahedron(), 1.3);
  check_against_solid(bracket(), 1.5);
  check_against_solid(sphere_of_triangles(2), 1.2);
}

TEST_CASE("a surface wound inside out is the same shape") {
  std::vector<Facet> inside_out = octahedron();
  for (Facet& facet : inside_out) std::swap(facet[0], facet[1]);
  CHECK(triangle_shape(inside_out)->nearest({0, 0, 0}).distance == Approx(-1 / std::sqrt(3)).epsilon(1e-14));
  CHECK(triangle_shape(inside_out)->nearest({0, 0, 3}).distance == 2);
}

TEST_CASE("a sphere of triangles lies within the height of their caps from the sphere") {
  const std::vector<Facet> triangles = sphere_of_triangles(4);
  const auto shape = triangle_shape(triangles), exact = ball<3>({0, 0, 0}, 1);
  Largest above, below;
  for (const Vector3d& x : positions_by_chance<3>(500, 1.5)) {
    const double excess = shape->nearest(x).distance - exact->nearest(x).distance;
    above.take(excess);
    below.take(-excess);
  }
  Largest squared_side;
  for (const auto& [a, b, c] : triangles) squared_side.take((Vector3d(a.data()) - Vector3d(b.data())).squaredNorm());
  CHECK(above.value() < squared_side.value() / 6);
  CHECK(below.value() < 1e-14);
}

TEST_CASE("an edge of four triangles, and one with a triangle of no area on it, keep the sides apart") {
  std::vector<Facet> two_cubes = box_of_triangles({-1, -1, -0.5}, {0, 0, 0.5});  // which touch along the z axis
  for (const Facet& facet : box_of_triangles({0, 0, -0.5}, {1, 1, 0.5})) two_cubes.push_back(facet);
  check_against_solid(two_cubes, 1.5);

  std::vector<Facet> split = octahedron();  // (1, 0, 0), (0, 1, 0), (0, 0, 1) first, then that with −x
  const SpacePoint a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1}, middle{0.5, 0.5, 0};
  split[0] = {a, middle, c};
  split.push_back({middle, b, c});
  split.push_back({a, b, middle});
  check_against_solid(split, 1.3);
  CHECK(triangle_shape(split)->nearest({1, 1, -1e-3}).distance > 0);
  CHECK(triangle_shape(split)->nearest(Vector3d(middle.data())).normal.allFinite());
}

TEST_CASE("on an edge or a corner itself phi is 0 and the normal that of a triangle there") {
  const auto shape = triangle_shape(box_of_triangles({0, 0, 0}, {1, 1, 1}));
  for (const Vector3d& x : {Vector3d(0, 0, 0), Vector3d(1, 0.25, 1), Vector3d(1, 1, 1)}) {
    const Nearest<3> here = shape->nearest(x);
    CHECK(here.distance == 0);
    CHECK(here.normal.cwiseAbs().sum() == 1);
    CHECK(here.normal.dot(x - Vector3d::Constant(0.5)) == 0.5);
    CHECK(here.hessian.isZero(0));
  }
}

TEST_CASE("triangles that are open, or enclose nothing, are refused") {
  std::vector<Facet> open = octahedron();
  open.pop_back();
  CHECK_THROWS_WITH(triangle_shape(open), Contains("the surface is not closed: the edge from"));
  CHECK_THROWS_WITH(triangle_shape(std::vector<Facet>{}), Contains("encloses no volume"));
  const Facet facet{SpacePoint{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, back{facet[0], facet[2], facet[1]};
  CHECK_THROWS_WITH(triangle_shape({facet, back}), Contains("encloses no volume"));
}

#include "geometry/mesh_border.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;
using std::numbers::pi;

namespace {

Mesh mesh_of(std::vector<SpacePoint> nodes, std::vector<MeshElement> elements) {
  Mesh mesh{{}, std::move(elements)};
  for (std::size_t k = 0; k < nodes.size(); ++k) mesh.nodes[k] = nodes[k];
  return mesh;
}

/// A ring between circles of radius 1 and 2 about the origin, in n quadrilaterals, of which every other is wound
/// clockwise.
Mesh ring(std::size_t n) {
  std::vector<SpacePoint> nodes;
  std::vector<MeshElement> elements;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
    for (const double r : {1.0, 2.0}) nodes.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    const std::size_t next = (k + 1) % n;
    MeshElement& element = elements.emplace_back(MeshElement{3, {2 * k, 2 * k + 1, 2 * next + 1, 2 * next}});
    if (k % 2 == 1) std::ranges::reverse(element.nodes);
  }
  return mesh_of(nodes, elements);
}

/// The area of n triangles between the centre and the sides of a polygon of n corners on a circle.
double area_of(std::size_t n, double r) {
  const auto sides = static_cast<double>(n);
  return sides * r * r * std::sin(2 * pi / sides) / 2;
}

double volume_of(const Mesh& mesh) {
  std::string fault;
  const std::vector<Facet> facets = surface_of(mesh, fault);
  CHECK(fault.empty());
  CHECK_FALSE(open_edge(facets));
  return signed_volume(facets);
}

const std::vector<SpacePoint> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                      {1, 1, 1}, {0, 1, 1}, {0, 0, 3}, {1, 0, 3}, {1, 1, 3}, {0, 1, 3}};

}  // namespace

TEST_CASE("the border of a ring is a loop around it and a hole, whichever way its elements are wound") {
  std::string fault;
  const std::vector<Polygon> loops = loops_around(ring(64), fault);
  CHECK(fault.empty());
  REQUIRE(loops.size() == 2);
  std::vector<double> areas = {signed_area(loops[0]), signed_area(loops[1])};
  std::ranges::sort(areas);
  CHECK(areas[0] == Approx(-area_of(64, 1)).epsilon(1e-12));
  CHECK(areas[1] == Approx(area_of(64, 2)).epsilon(1e-12));
}

TEST_CASE("loops that are joined enclose what they did, and the lines between them are none of the border") {
  std::string fault;
  const Polygon polygon = joined(loops_around(ring(64), fault));
  CHECK(signed_area(polygon) == Approx(area_of(64, 2) - area_of(64, 1)).epsilon(1e-12));
  CHECK(contains(polygon, {1.5, 0.1}));
  CHECK_FALSE(contains(polygon, {0.5, 0.1}));
  CHECK_FALSE(contains(polygon, {2.5, 0.1}));
  CHECK(polygon.size() == 130);
  CHECK(std::ranges::count(edges_of_border(polygon), char{1}) == 128);
}

TEST_CASE("a joining line goes around a hole that lies in between") {
  // The nearest corners of the inner squares and of the outline are joined; no line crosses another.
  const auto square = [](double x, double y, double half) {  // clockwise
    return Polygon{{x - half, y - half}, {x - half, y + half}, {x + half, y + half}, {x + half, y - half}};
  };
  Polygon outline = square(0, 0, 10);
  std::ranges::reverse(outline);
  const Polygon polygon = joined({outline, square(-4, 1, 1), square(0, 0, 1), square(4, -1, 1)});
  CHECK(signed_area(polygon) == Approx(400 - 3 * 4).epsilon(1e-14));
  CHECK(std::ranges::count(edges_of_border(polygon), char{1}) == 16);
  const std::vector<char> of_border = edges_of_border(polygon);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (of_border[k]) continue;
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    for (const double share : {0.25, 0.5, 0.75}) {  // a line to either side of it lies in the material
      const double nx = 1e-6 * (b[1] - a[1]), ny = -1e-6 * (b[0] - a[0]);
      const double x = std::lerp(a[0], b[0], share), y = std::lerp(a[1], b[1], share);
      CHECK(contains(polygon, {x + nx, y + ny}));
      CHECK(contains(polygon, {x - nx, y - ny}));
    }
  }
}

TEST_CASE("sides of elements in one line are one side, and curved ones are two lines each") {
  std::string fault;
  const std::vector<SpacePoint> nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}};
  const Polygon box = loops_around(mesh_of(nodes, {{3, {0, 1, 4, 5}}, {2, {1, 2, 3}}, {2, {1, 3, 4}}}), fault).at(0);
  CHECK(box.size() == 4);
  CHECK(signed_area(box) == 2);
  const Polygon curved =
      loops_around(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0.75, 0.75, 0}, {0, 0.5, 0}},
                           {{9, {0, 1, 2, 3, 4, 5}}}),
                   fault)
          .at(0);
  CHECK(curved.size() == 4);
  CHECK(signed_area(curved) == Approx(0.5 + 0.25).epsilon(1e-15));
  CHECK(fault.empty());
}

TEST_CASE("the surface of hexahedra, prisms, pyramids and tetrahedra of either order is closed around their volume") {
  CHECK(volume_of(mesh_of(cube, {{5, {0, 1, 2, 3, 4, 5, 6, 7}}, {5, {4, 5, 6, 7, 8, 9, 10, 11}}})) == Approx(3));
  CHECK(volume_of(mesh_of(cube, {{5, {4, 5, 6, 7, 0, 1, 2, 3}}})) == Approx(1));  // inside out
  CHECK(volume_of(mesh_of(cube, {{6, {0, 1, 2, 4, 5, 6}}})) == Approx(0.5));
  CHECK(volume_of(mesh_of(cube, {{7, {0, 1, 2, 3, 6}}})) == Approx(1.0 / 3));
  CHECK(volume_of(mesh_of(cube, {{4, {0, 1, 2, 6}}, {4, {0, 5, 1, 6}}})) == Approx(2.0 / 6));
  for (const std::vector<std::size_t>& corners :
       {std::vector<std::size_t>{0, 1, 3, 4}, std::vector<std::size_t>{1, 0, 3, 4}}) {
    std::vector<SpacePoint> nodes;
    for (const std::size_t k : corners) nodes.push_back(cube[k]);
    for (const auto& [i, j] : {std::pair(0, 1), {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}) {
      SpacePoint middle{};
      for (std::size_t d = 0; d < 3; ++d)
        middle[d] = (nodes[static_cast<std::size_t>(i)][d] + nodes[static_cast<std::size_t>(j)][d]) / 2;
      nodes.push_back(middle);
    }
    CHECK(volume_of(mesh_of(nodes, {{11, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}})) == Approx(1.0 / 6));
  }
}

TEST_CASE("a mesh whose elements lie in each other, or off the plane, has no border, and says where") {
  std::string fault;
  const std::vector<SpacePoint> nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0, 0, 1}, {0, 0, 2}};
  CHECK(loops_around(mesh_of(nodes, {{2, {0, 1, 2}}, {2, {0, 1, 3}}}), fault).empty());
  CHECK_THAT(fault, Catch::Contains("lie in each other at (0, 0)"));
  CHECK(loops_around(mesh_of(nodes, {{2, {0, 1, 4}}}), fault).empty());
  CHECK_THAT(fault, Catch::Contains("plane of x and y") && Catch::Contains("(0, 0, 1)"));
  CHECK(surface_of(mesh_of(nodes, {{4, {0, 1, 2, 4}}, {4, {0, 1, 2, 5}}, {4, {0, 1, 2, 3}}}), fault).empty());
  CHECK_THAT(fault, Catch::Contains("lie in each other"));
}

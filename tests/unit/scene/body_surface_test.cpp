// Pieces of curved surfaces: areas, and normals that enclose the body.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "scene/body_border.hpp"
#include "temporary_folder.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using stillpoint::test::TemporaryFolder;

namespace {

constexpr double pi = std::numbers::pi;

struct Sums {
  double area = 0, volume = 0;  // ∫ dA and ⅓ ∫ x·n dA
  std::array<double, 3> vector{};
};
Sums sums(const BodySpec& body, const std::vector<BodySurface>& surfaces, double length = 0.1) {
  Sums all;
  for (const BodySurface surface : surfaces) {
    CHECK(why_no_surface(body, surface).empty());
    for (const SurfacePiece& piece : surface_pieces(body, surface, length)) {
      all.area += std::hypot(piece.vector[0], piece.vector[1], piece.vector[2]);
      for (std::size_t d = 0; d < 3; ++d) {
        all.vector[d] += piece.vector[d];
        all.volume += piece.x[d] * piece.vector[d] / 3;
      }
    }
  }
  return all;
}
void check_closed(const Sums& all) {
  for (const double along : all.vector) CHECK(std::abs(along) < 1e-9 * all.area);
}
BodySpec in_box(double low, double high) {
  BodySpec body;
  body.min = std::vector(3, low);
  body.max = std::vector(3, high);
  return body;
}

}  // namespace

using enum BodySurface;

TEST_CASE("the pieces of a sphere, outside and inside, have its area and enclose its volume") {
  BodySpec body = in_box(-5, 5);
  body.sphere = {0.5, -0.3, 0.2};
  body.radius = 2;
  body.inner_radius = 1;
  CHECK(sums(body, {outer}).area == Approx(16 * pi).epsilon(1e-6));
  CHECK(sums(body, {inner}).area == Approx(4 * pi).epsilon(1e-6));
  const Sums both = sums(body, {outer, inner});
  check_closed(both);
  CHECK(both.volume == Approx(4 * pi / 3 * 7).epsilon(1e-6));
}

TEST_CASE("of an eighth of a sphere the pieces are an eighth, and push along each axis by a quarter circle's area") {
  BodySpec body = in_box(0, 5);
  body.sphere = {0, 0, 0};
  body.radius = 2;
  const Sums eighth = sums(body, {outer});
  CHECK(eighth.area == Approx(2 * pi).epsilon(1e-6));
  for (const double along : eighth.vector) CHECK(along == Approx(pi).epsilon(1e-6));
}

TEST_CASE("the pieces of a cylinder, askew and hollow, enclose its volume with those of its ends") {
  BodySpec body = in_box(-5, 5);
  body.cylinder = {{0, 0.1, 0}, {1, 2.1, 2}};
  body.radius = 1;
  body.inner_radius = 0.5;
  const Sums all = sums(body, {outer, inner, start, end});
  check_closed(all);
  CHECK(all.volume == Approx(3 * pi * 0.75).epsilon(1e-6));
  CHECK(sums(body, {outer}).area == Approx(6 * pi).epsilon(1e-6));
  CHECK(sums(body, {end}).area == Approx(pi * 0.75).epsilon(1e-6));
  CHECK(sums(body, {end}).vector[0] == Approx(pi * 0.75 / 3).epsilon(1e-6));
  CHECK(sums(body, {start}).vector[0] == Approx(-pi * 0.75 / 3).epsilon(1e-6));
}

TEST_CASE("a quarter of a cylinder along an axis has a quarter of its pieces") {
  BodySpec body = in_box(0, 5);
  body.cylinder = {{0, 0, 0}, {0, 0, 3}};
  body.radius = 2;
  CHECK(sums(body, {outer}).area == Approx(3 * pi).epsilon(1e-6));
  CHECK(sums(body, {end}).area == Approx(pi).epsilon(1e-6));
}

TEST_CASE("the pieces of a prism, along any axis and cut off by its box, enclose it exactly") {
  for (const int axis : {0, 1, 2}) {
    BodySpec body = in_box(-5, 5);
    body.polygon = {{0, 0}, {1, 0}, {0.3, 0.4}, {0, 1}};
    body.axis = axis;
    std::vector<double> low = body.min, high = body.max;
    low.at(static_cast<std::size_t>(axis)) = 0.2;
    high.at(static_cast<std::size_t>(axis)) = 1.7;
    body.min = low;
    body.max = high;
    const Sums all = sums(body, {outer, start, end});
    check_closed(all);
    CHECK(all.volume == Approx(0.35 * 1.5).epsilon(1e-12));
    CHECK(sums(body, {end}).area == Approx(0.35).epsilon(1e-12));
  }
  BodySpec body = in_box(0, 5);
  body.polygon = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  CHECK(sums(body, {outer}).area == Approx(2 * 5).epsilon(1e-12));
}

TEST_CASE("the pieces of a surface of triangles have its area") {
  const TemporaryFolder folder;
  BodySpec body = in_box(-5, 5);
  body.stl = folder.write("body.stl", binary_stl(octahedron()));
  const Sums all = sums(body, {outer});
  check_closed(all);
  CHECK(all.area == Approx(4 * std::sqrt(3)).epsilon(1e-6));
  CHECK(all.volume == Approx(4.0 / 3).epsilon(1e-6));
}

TEST_CASE("a body is asked only for surfaces that it has") {
  BodySpec body = in_box(-5, 5);
  body.sphere = {0, 0, 0};
  body.radius = 1;
  CHECK_FALSE(why_no_surface(body, inner).empty());
  CHECK_FALSE(why_no_surface(body, start).empty());
}

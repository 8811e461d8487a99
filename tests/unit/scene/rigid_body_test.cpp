// The shapes that rigid bodies of a scene have: their signed distances against formulas.
#include "scene/rigid_body.hpp"

#include <stillpoint/scene.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/shape_checks.hpp"
#include "scene/rigid_scenes.hpp"
#include "temporary_folder.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;
using Eigen::Vector2d, Eigen::Vector3d;

namespace stillpoint::test {
namespace {

constexpr double kEps = 1e-14;

/// The distance from the shape of the only rigid body, which these lines give a scene in the plane.
double plane(const std::string& shape, const Vector2d& x) {
  return rigid_shape<2>(plane_scene(shape).rigid.at(0), false)->nearest(x).distance;
}
double axisymmetric(const std::string& shape, const Vector2d& x) {
  const Scene scene = plane_scene(shape, "axisymmetric");
  REQUIRE(scene.state == StressState::axisymmetric);
  return rigid_shape<2>(scene.rigid.at(0), true)->nearest(x).distance;
}
double space(const std::string& shape, const Vector3d& x) {
  return rigid_shape<3>(space_scene(shape).rigid.at(0), false)->nearest(x).distance;
}

auto close_to(double value) { return Approx(value).epsilon(kEps).margin(kEps); }

}  // namespace

TEST_CASE("half-planes, boxes, polygons and discs of a scene have the signed distance of their formulas") {
  CHECK(plane("half_plane = [[0, 1], [3, 4]]", {5, 2}) == close_to((3 * 5 + 4 * 1) / 5.0));
  CHECK(plane("half_plane = [[0, 1], [3, 4]]", {0, 0}) == close_to(-0.8));

  const std::string box = "min = [0, 0]\nmax = [2, 1]\nrounding = 0.25";
  CHECK(plane(box, {1, 0.75}) == close_to(-0.25));
  CHECK(plane(box, {1, 1.5}) == close_to(0.5));
  CHECK(plane(box, {2, 1}) == close_to(0.25 * (std::numbers::sqrt2 - 1)));
  CHECK(plane("min = [0, 0]\nmax = [2, 1]", {2, 1}) == 0);

  const std::string angle = "polygon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]\nrounding = 0.25";
  CHECK(plane(angle, {1.5, 0.9}) == close_to(-0.1));
  CHECK(plane(angle, {1.3, 1.4}) == close_to(0.3));
  CHECK(plane(angle, {2, 0}) == close_to(0.25 * (std::numbers::sqrt2 - 1)));
  CHECK(plane(angle, {1, 1}) == close_to(0));  // a corner that is no convex one stays

  CHECK(plane("disc = [1, 2]\nradius = 0.5", {4, 6}) == close_to(4.5));
  CHECK(plane("disc = [1, 2]\nradius = 0.5", {1.1, 2}) == close_to(-0.4));
}

TEST_CASE("the angle of a wedge is that from flank to flank in degrees, and its shaft is 2 radius wide") {
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const std::string wedge = "wedge = [[1, 1], [0, 2]]\nangle = 60";
  CHECK(plane(wedge, {1, 3}) == close_to(-2 * s));
  CHECK(plane(wedge, {3, 1.5}) == close_to(2 * c - 0.5 * s));
  CHECK(plane(wedge, {1, 0}) == close_to(1));
  CHECK(plane(wedge + "\nrounding = 0.2", {1, 1}) == close_to(0.2 / s - 0.2));

  const std::string with_shaft = wedge + "\nradius = 0.5";
  const double shoulder = 1 + 0.5 * c / s;
  CHECK(plane(with_shaft, {1.75, 40}) == close_to(0.25));
  CHECK(plane(with_shaft, {0.75, 40}) == close_to(-0.25));
  CHECK(plane(with_shaft, {1.25, 1.1}) == close_to(0.25 * c - 0.1 * s));
  CHECK(plane(with_shaft, {1.5 + 0.3, shoulder - 0.1}) == close_to(std::hypot(0.3, 0.1)));
}

TEST_CASE("what reaches the axis of symmetry has no surface there") {
  CHECK(axisymmetric("min = [0, 0]\nmax = [1, 4]", {0, 2}) == -1);
  CHECK(axisymmetric("min = [0, 0]\nmax = [1, 4]\nrounding = 0.5", {0.25, 4.25}) == close_to(0.25));
  CHECK(axisymmetric("min = [1, 0]\nmax = [2, 4]", {1.25, 2}) == -0.25);  // a ring
  CHECK(axisymmetric("polygon = [[0, 0], [1, 0], [1, 4], [0, 4]]", {0, 2}) == -1);
  CHECK(axisymmetric("polygon = [[1, 0], [2, 0], [2, 4], [1, 4]]", {1.25, 2}) == -0.25);
  CHECK(axisymmetric("disc = [0, 1]\nradius = 0.5", {0, 2}) == 0.5);
  CHECK(axisymmetric("disc = [1, 1]\nradius = 0.5", {0, 1}) == 0.5);
}

TEST_CASE("a cone is in the half plane the wedge on the axis, and in space that wedge turned about its direction") {
  for (const char* const more : {"", "\nrounding = 0.2", "\nradius = 0.5", "\nradius = 0.5\nrounding = 0.2"}) {
    INFO(more);
    const std::string keys = std::string("\nangle = 60") + more;
    const auto wedge = rigid_shape<2>(plane_scene("wedge = [[0, -1], [0, 1]]" + keys, "axisymmetric").rigid[0], true);
    const auto in_plane = rigid_shape<2>(plane_scene("wedge = [[0, -1], [0, 1]]" + keys).rigid[0], false);
    const auto cone = rigid_shape<3>(space_scene("cone = [[0, -1, 0], [0, 3, 0]]" + keys).rigid[0], false);
    Largest off;
    for (const Vector3d& x : positions_by_chance<3>(200, 2)) {
      const Vector2d at(std::hypot(x[0], x[2]), x[1]);
      off.take_magnitude(wedge->nearest(at).distance - in_plane->nearest(at).distance);
      off.take_magnitude(wedge->nearest(at).distance - cone->nearest(x).distance);
    }
    CHECK(off.value() < kEps);
  }
}

TEST_CASE("a half-plane that slants towards the axis of symmetry is a cone, or what is outside one") {
  // r + z <= 1 and r + z >= 1, whose cone has its tip at z = 1
  CHECK(axisymmetric("half_plane = [[1, 0], [1, 1]]", {1, 1}) == close_to(std::sqrt(0.5)));
  CHECK(axisymmetric("half_plane = [[1, 0], [1, 1]]", {0, 3}) == close_to(2));
  CHECK(axisymmetric("half_plane = [[1, 0], [1, 1]]", {0, 0}) == close_to(-std::sqrt(0.5)));
  CHECK(axisymmetric("half_plane = [[1, 0], [-1, -1]]", {0, 0}) == close_to(std::sqrt(0.5)));
  CHECK(axisymmetric("half_plane = [[1, 0], [-1, -1]]", {0, 3}) == close_to(-2));
  CHECK(axisymmetric("half_plane = [[1, 0], [1, -1]]", {0, -3}) == close_to(2));  // r - z <= 1
  CHECK(axisymmetric("half_plane = [[0, 0.5], [0, 1]]", {3, 2}) == 1.5);
  CHECK(axisymmetric("half_plane = [[2, 0], [-1, 0]]", {1.5, 7}) == 0.5);  // a pipe
  CHECK(axisymmetric("half_plane = [[2, 0], [1, 0]]", {2.5, 7}) == 0.5);   // a pile
}

TEST_CASE("half-spaces, boxes, spheres, cylinders and cones of a scene have the signed distance of their formulas") {
  CHECK(space("half_plane = [[0, 1, 0], [0, 3, 4]]", {9, 2, 1}) == close_to(7.0 / 5));
  CHECK(space("min = [0, 0, 0]\nmax = [1, 2, 4]", {4, 6, 3}) == 5);
  CHECK(space("min = [0, 0, 0]\nmax = [1, 2, 4]", {0.5, 1, 3.75}) == -0.25);
  CHECK(space("min = [0, 0, 0]\nmax = [1, 1, 1]\nrounding = 0.25", {1, 1, 1}) ==
        close_to(0.25 * (std::numbers::sqrt3 - 1)));
  CHECK(space("sphere = [1, 0, 0]\nradius = 2", {1, 3, 4}) == close_to(3));
  CHECK(space("sphere = [1, 0, 0]\nradius = 2", {1, 1, 0}) == close_to(-1));
  const std::string cylinder = "cylinder = [[0, 0, 0], [0, 0, 3]]\nradius = 1";
  CHECK(space(cylinder, {3, 4, 1}) == close_to(4));
  CHECK(space(cylinder, {0, 0.5, 1}) == close_to(-0.5));
  CHECK(space(cylinder + "\nrounding = 0.25", {0, 1, 3}) == close_to(0.25 * (std::numbers::sqrt2 - 1)));
  const std::string cone = "cone = [[0, 0, 0], [0, 1, 0]]\nangle = 60";
  CHECK(space(cone, {3, 2, 4}) == close_to(5 * std::cos(std::numbers::pi / 6) - 2 * 0.5));
  CHECK(space(cone + "\nradius = 0.5", {3, 50, 4}) == close_to(4.5));
}

TEST_CASE("a rigid body may have the surface of an STL file, which is read once, when its scene is checked") {
  const TemporaryFolder folder;
  const auto file = folder.write("body.stl", ascii_stl(octahedron()));
  const Scene scene = load_scene(folder.write("scene.toml", space_text("stl = \"body.stl\"")));
  std::filesystem::remove(file);
  const auto shape = rigid_shape<3>(scene.rigid.at(0), false);
  CHECK(shape->nearest({0.5, 0.5, 0.5}).distance == close_to(0.5 / std::numbers::sqrt3));
  CHECK(shape->nearest({0, 0, 0}).distance == close_to(-1 / std::numbers::sqrt3));
  CHECK(shape->nearest({0, 3, 0}).distance == close_to(2));
  RigidSpec other = scene.rigid[0];
  other.stl = folder.path() / "none.stl";
  CHECK_THROWS_WITH(rigid_shape<3>(other, false), Contains("none.stl' there is no such file"));
}

TEST_CASE("keys that make no shape are refused with one message") {
  CHECK_THROWS_WITH(rigid_shape<2>({}, false), Contains("without a shape"));
  CHECK_THROWS_WITH(rigid_shape<3>({}, false), Contains("without a shape"));
  RigidSpec spec;
  spec.disc = {1, 2, 3};
  CHECK_THROWS_WITH(rigid_shape<2>(spec, false), Contains("expected 2 coordinates, found 3"));
  spec.disc = {1, 2};
  CHECK_THROWS_WITH(rigid_shape<2>(spec, false), Contains("the radius 0 is not positive"));
  spec = {};
  spec.cone = {{0, 0, 0}};
  CHECK_THROWS_WITH(rigid_shape<3>(spec, false), Contains("expected two positions, or a position and a direction"));
}

}  // namespace stillpoint::test

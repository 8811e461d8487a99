// Checks of the shapes of bodies in space, and of the corners of polygons.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/body_solid.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

// In the order of BodyShape, from BodyShape::polygon on.
constexpr std::array kShapes = {"polygon", "sphere", "cylinder", "stl", "mesh"};

/// The key that gives the shape of a body: the first that is written, or that of the shape.
std::string shape_key(const SceneCheck& check, std::size_t k) {
  for (const char* const shape : kShapes)
    if (check.written(check.body_key(k, shape))) return check.body_key(k, shape);
  if (!check.scene().bodies[k].mesh.empty()) return check.body_key(k, "mesh");
  const auto polygon = static_cast<std::size_t>(BodyShape::polygon);
  return check.body_key(k, kShapes.at(static_cast<std::size_t>(check.scene().bodies[k].shape()) - polygon));
}

bool check_radii(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string inner = check.body_key(k, "inner_radius");
  return body.radius > 0 && check.sound(check.body_key(k, "radius")) && check.sound(inner) &&
         !check.wrong_if(!(body.inner_radius < body.radius), inner, "must be less than radius = {}, not {}",
                         body.radius, body.inner_radius);
}

/// True if all of the shape is known.
bool check_shape(SceneCheck& check, std::size_t k, const std::string& key) {
  const BodySpec& body = check.scene().bodies[k];
  switch (body.shape()) {
    case BodyShape::polygon:
      return check_corners(check, k);
    case BodyShape::sphere:
      return check_radii(check, k);
    case BodyShape::cylinder:
      return check.two_positions(key, body.cylinder) && check_radii(check, k);
    case BodyShape::triangles:
      return body.from_stl.solid != nullptr;  // what is wrong with the file was reported
    case BodyShape::box:                      // what is written of another shape could not be read
    case BodyShape::points:
      break;
  }
  return false;
}

/// True if the whole shape lies in the grid, except on the sides where the scene cuts it off.
bool stands_in_grid(SceneCheck& check, const BodySpec& body, std::size_t k, const std::string& key,
                    const SpaceBox& shape) {
  const GridSpec& grid = check.scene().grid;
  for (std::size_t d = 0; d < 3; ++d) {
    for (const bool upper : {false, true}) {
      const double slack = 2 * kSliver * known_cell_length_at(grid, d, (upper ? grid.max : grid.min)[d]);
      const bool stands_out = upper ? shape.high[d] > grid.max[d] + slack : shape.low[d] < grid.min[d] - slack;
      if (check.wrong_if(stands_out && !(upper ? body.max : body.min).is_asked(), key,
                         "reaches from {:.6g} to {:.6g} along {}, out of the grid, {} to {}; where it is to be cut "
                         "off, give {}",
                         shape.low[d], shape.high[d], "xyz"[d], grid.min[d], grid.max[d],
                         check.body_key(k, upper ? "max" : "min")))
        return false;
    }
  }
  return true;
}

}  // namespace

// Where the lines a b and c d meet; empty if they are parallel.
std::optional<PlanePoint> crossing(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  const auto cross = [](double x, double y, double z, double w) { return x * w - y * z; };
  const double x = b[0] - a[0], y = b[1] - a[1], z = d[0] - c[0], w = d[1] - c[1];
  const double turn = cross(x, y, z, w);
  constexpr double rounding = 1e-12;
  if (std::abs(turn) <= rounding * std::hypot(x, y) * std::hypot(z, w)) return std::nullopt;
  const double share = cross(c[0] - a[0], c[1] - a[1], z, w) / turn;
  return PlanePoint{a[0] + share * x, a[1] + share * y};
}

bool has_shape_key(const SceneCheck& check, std::size_t k) {
  return check.scene().bodies[k].has_shape() ||
         std::ranges::any_of(kShapes, [&](const char* shape) { return check.written(check.body_key(k, shape)); });
}

bool check_corners(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = check.body_key(k, "polygon");
  const std::size_t n = body.polygon.size();
  constexpr std::size_t most = 1000;  // that can be compared two by two
  if (check.wrong_if(n < 3 || n > most, key, "needs from 3 to {} corners, not {}", most, n) ||
      check.wrong_if(body.polygon.front() == body.polygon.back(), key,
                     "the last corner repeats the first; a polygon closes by itself"))
    return false;
  const Polygon polygon = outline_of(body);
  double box = 1;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto [low, high] = std::ranges::minmax_element(polygon, {}, [d](const PlanePoint& x) { return x[d]; });
    box *= (*high)[d] - (*low)[d];
  }
  const auto edges = crossing_edges(polygon);
  const auto [a, b] = edges.value_or(std::pair<std::size_t, std::size_t>());
  const auto at = edges ? crossing(polygon[a], polygon[(a + 1) % n], polygon[b], polygon[(b + 1) % n]) : std::nullopt;
  if (check.wrong_if(
          at.has_value(), key,
          "its sides cross or touch at ({:.6g}, {:.6g}): that from corner {} to {} and that from {} to {}; expected "
          "corners in their order around the body",
          at.value_or(PlanePoint())[0], at.value_or(PlanePoint())[1], a, (a + 1) % n, b, (b + 1) % n))
    return false;
  constexpr double rounding = 1e-12;
  if (check.wrong_if(std::abs(signed_area(polygon)) <= rounding * box, key, "has no area")) return false;
  return !check.wrong_if(edges.has_value(), key,
                         "must not touch itself, as the sides from corner {} to {} and from {} to {} do", a,
                         (a + 1) % n, b, (b + 1) % n);
}

bool check_solid(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = shape_key(check, k);
  if (!check.sound(key) || !check_shape(check, k, key)) return false;
  const std::shared_ptr<const Solid> solid = solid_of(body);
  if (!stands_in_grid(check, body, k, key, solid->bounds())) return false;
  const SpaceBox part = in_common(solid->bounds(), box_of(body));
  return !check.wrong_if(!(part.volume() > 0) || !(volume_in(*solid, part) > 0), key,
                         "nothing of it lies between min, ({}), and max, ({})", fmt::join(body.min, ", "),
                         fmt::join(body.max, ", "));
}

}  // namespace stillpoint

// Checks of the shapes of bodies in space, and of the corners of polygons.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/body_solid.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

// In the order of BodyShape, from BodyShape::polygon on.
constexpr std::array kShapes = {"polygon", "sphere", "cylinder", "stl"};

/// The key that gives the shape of a body: the first that is written, or that of the shape.
std::string shape_key(const SceneCheck& check, std::size_t k) {
  for (const char* const shape : kShapes)
    if (check.written(check.body_key(k, shape))) return check.body_key(k, shape);
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
  constexpr double rounding = 1e-12;
  if (check.wrong_if(std::abs(signed_area(polygon)) <= rounding * box, key, "has no area")) return false;
  const auto edges = crossing_edges(polygon);
  const auto [a, b] = edges.value_or(std::pair<std::size_t, std::size_t>());
  return !check.wrong_if(edges.has_value(), key,
                         "must not cross or touch itself, as the edges from corner {} to {} and from {} to {} do", a,
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

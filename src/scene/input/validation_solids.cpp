#include "scene/input/validation_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "scene/body_solid.hpp"
#include "scene/outline.hpp"

namespace stillpoint {
namespace {

constexpr std::array kShapes = {"polygon", "sphere", "cylinder", "stl"};

bool check_radii(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string inner = check.body_key(k, "inner_radius");
  if (!(body.radius > 0) || !check.sound(check.body_key(k, "radius")) || !check.sound(inner)) return false;
  if (body.inner_radius < body.radius) return true;
  check.add(inner, fmt::format("must be less than radius = {}, not {}", body.radius, body.inner_radius));
  return false;
}

bool check_cylinder(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = check.body_key(k, "cylinder");
  if (body.cylinder.size() != 2) {
    check.add(key, fmt::format("must be two positions, [from, to], not {}", body.cylinder.size()));
    return false;
  }
  if (body.cylinder[0] != body.cylinder[1]) return check_radii(check, k);
  check.add(key, "the two positions are the same");
  return false;
}

/// That the whole shape lies in its box, but for where it is cut off on purpose.
bool stands_in_box(SceneCheck& check, std::size_t k, const std::string& key, const SpaceBox& shape) {
  const Scene& scene = check.scene();
  const BodySpec& body = scene.bodies[k];
  for (std::size_t d = 0; d < 3; ++d) {
    const double slack = 2 * kSliver * check.cell_length(d);
    for (const bool upper : {false, true}) {
      const char* const side = upper ? "max" : "min";
      const bool stands_out =
          upper ? shape.high[d] > scene.grid.max[d] + slack : shape.low[d] < scene.grid.min[d] - slack;
      if (!stands_out || (upper ? body.max : body.min).is_asked()) continue;
      check.add(key, fmt::format("reaches from {:.6g} to {:.6g} along {}, out of the grid, {} to {}; where it is to be "
                                 "cut off, give {}",
                                 shape.low[d], shape.high[d], "xyz"[d], scene.grid.min[d], scene.grid.max[d],
                                 check.body_key(k, side)));
      return false;
    }
  }
  return true;
}

}  // namespace

void check_shape_keys(SceneCheck& check, const std::string& table) {
  std::string first;
  for (const char* const shape : kShapes) {
    const std::string key = fmt::format("{}.{}", table, shape);
    if (!check.written(key) || check.written(table + ".file")) continue;
    if (!first.empty()) check.add(key, fmt::format("does not go with {}; a body has one shape", first));
    if (first.empty()) first = shape;
  }
  const bool is_round = check.written(table + ".sphere") || check.written(table + ".cylinder");
  if (is_round && !check.written(table + ".radius"))
    check.add(table + (check.written(table + ".sphere") ? ".sphere" : ".cylinder"), "needs a radius");
  if (!is_round) check.refuse(table, {"radius", "inner_radius"}, "goes with sphere or cylinder");
  if (!check.written(table + ".polygon"))
    check.refuse(table, {"axis"}, "goes with polygon, which is drawn out along it");
}

bool has_shape_key(const SceneCheck& check, std::size_t k) {
  return check.scene().bodies[k].has_shape() ||
         std::ranges::any_of(kShapes, [&](const char* shape) { return check.written(check.body_key(k, shape)); });
}

/// The key that gives its shape.
std::string shape_key(const SceneCheck& check, std::size_t k) {
  const auto written =
      std::ranges::find_if(kShapes, [&](const char* shape) { return check.written(check.body_key(k, shape)); });
  if (written != kShapes.end()) return *written;
  return kShapes.at(static_cast<std::size_t>(check.scene().bodies[k].shape()) -
                    static_cast<std::size_t>(BodyShape::polygon));
}

bool check_corners(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = check.body_key(k, "polygon");
  const auto wrong = [&](const std::string& message) { return check.add(key, message), false; };
  const std::size_t n = body.polygon.size();
  constexpr std::size_t most = 1000;  // that can be compared two by two
  if (n < 3 || n > most) return wrong(fmt::format("needs from 3 to {} corners, not {}", most, n));
  if (body.polygon.front() == body.polygon.back())
    return wrong("the last corner repeats the first; a polygon closes by itself");
  const Polygon polygon = outline_of(body);
  double box = 1;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto [low, high] = std::ranges::minmax_element(polygon, {}, [d](const PlanePoint& x) { return x[d]; });
    box *= (*high)[d] - (*low)[d];
  }
  constexpr double rounding = 1e-12;
  if (std::abs(signed_area(polygon)) <= rounding * box) return wrong("has no area");
  if (const auto edges = crossing_edges(polygon)) {
    const auto [a, b] = *edges;
    return wrong(fmt::format("must not cross or touch itself, as the edges from corner {} to {} and from {} to {} do",
                             a, (a + 1) % n, b, (b + 1) % n));
  }
  return true;
}

bool is_in_order(SceneCheck& check, std::size_t k) {
  switch (check.scene().bodies[k].shape()) {
    case BodyShape::polygon:
      return check_corners(check, k);
    case BodyShape::sphere:
      return check_radii(check, k);
    case BodyShape::cylinder:
      return check_cylinder(check, k);
    case BodyShape::triangles:
      return check.scene().bodies[k].from_stl.solid != nullptr;  // what is wrong with the file was said
    case BodyShape::box:                                         // what is written of another shape could not be read
    case BodyShape::points:
      break;
  }
  return false;
}

bool check_solid(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string key = check.body_key(k, shape_key(check, k));
  if (!check.sound(key)) return false;
  if (!is_in_order(check, k)) return false;
  const std::shared_ptr<const Solid> solid = solid_of(body);
  if (!stands_in_box(check, k, key, solid->bounds())) return false;
  const SpaceBox part = in_common(solid->bounds(), box_of(body));
  if (!(part.volume() > 0) || !(volume_in(*solid, part) > 0)) {
    check.add(key, fmt::format("nothing of it lies between min, ({}), and max, ({})", fmt::join(body.min, ", "),
                               fmt::join(body.max, ", ")));
    return false;
  }
  return true;
}

}  // namespace stillpoint

#include "scene/input/validation_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/prism.hpp"
#include "base/text.hpp"
#include "scene/body_solid.hpp"
#include "scene/outline.hpp"

namespace stillpoint {
namespace {

constexpr std::array kShapes = {"polygon", "sphere", "cylinder", "stl"};

/// Corners that miss a line of the grid by a sliver are moved onto it.
bool check_prism(SceneCheck& check, std::size_t k) {
  BodySpec& body = check.scene().bodies[k];
  const auto axes = across(static_cast<std::size_t>(body.axis));
  for (std::vector<double>& corner : body.polygon) {
    std::vector<double> position = check.scene().grid.min;
    for (std::size_t d = 0; d < 2; ++d) position[axes[d]] = corner[d];
    check.snap_to_grid(position);
    for (std::size_t d = 0; d < 2; ++d) corner[d] = position[axes[d]];
  }
  return check_corners(check, k);
}

bool check_radii(SceneCheck& check, std::size_t k) {
  const BodySpec& body = check.scene().bodies[k];
  const std::string inner = check.body_key(k, "inner_radius");
  if (!check.written(check.body_key(k, "radius")) || !check.sound(check.body_key(k, "radius")) || !check.sound(inner))
    return false;
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

bool check_stl(SceneCheck& check, std::size_t k) {
  BodySpec& body = check.scene().bodies[k];
  std::vector<Problem> problems;
  body.from_stl = {.file = body.stl, .solid = read_stl_solid(body, problems)};
  for (Problem& problem : problems) {
    if (problem.where.line == 0) {  // the file as a whole: said where it is named
      check.add(check.body_key(k, "stl"), fmt::format("{} {}", in_quotes(body.stl.string()), problem.message));
    } else {
      check.add(std::move(problem));
    }
  }
  return problems.empty();
}

/// That the whole shape lies in its box, but for where it is cut off on purpose.
bool stands_in_box(SceneCheck& check, std::size_t k, const std::string& key, const SpaceBox& shape) {
  const Scene& scene = check.scene();
  const BodySpec& body = scene.bodies[k];
  for (std::size_t d = 0; d < 3; ++d) {
    const double slack = 2 * kSliver * check.cell_length(d);
    for (const bool upper : {false, true}) {
      const char* const side = upper ? "max" : "min";
      const bool stands_out = upper ? shape.high[d] > body.max[d] + slack : shape.low[d] < body.min[d] - slack;
      if (!stands_out || check.written(check.body_key(k, side))) continue;
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
  return std::ranges::any_of(kShapes, [&](const char* shape) { return check.written(check.body_key(k, shape)); });
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
      return check_prism(check, k);
    case BodyShape::sphere:
      return check_radii(check, k);
    case BodyShape::cylinder:
      return check_cylinder(check, k);
    case BodyShape::triangles:
      return check_stl(check, k);
    case BodyShape::box:  // what is written of another shape could not be read
    case BodyShape::points:
      break;
  }
  return false;
}

bool check_solid(SceneCheck& check, std::size_t k) {
  BodySpec& body = check.scene().bodies[k];
  const auto shape = std::ranges::find_if(kShapes, [&](const char* s) { return check.written(check.body_key(k, s)); });
  const std::string key = check.body_key(k, *shape);
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
  body.min.assign(part.low.begin(), part.low.end());
  body.max.assign(part.high.begin(), part.high.end());
  check.snap_to_grid(body.min);
  check.snap_to_grid(body.max);
  return true;
}

}  // namespace stillpoint

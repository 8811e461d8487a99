#include <algorithm>
#include <cmath>
#include <iterator>

#include "scene/body_border.hpp"
#include "scene/body_solid.hpp"

namespace stillpoint {
namespace {

// Counter-clockwise, so that outwards is to the right of each side.
Polygon sides_of(const BodySpec& body) {
  Polygon corners = outline_of(body);
  if (signed_area(corners) < 0) std::ranges::reverse(corners);
  return corners;
}

double size_of(const Polygon& corners) {
  double size = 0;
  for (const PlanePoint& corner : corners) {
    for (std::size_t d = 0; d < 2; ++d) size = std::max(size, std::abs(corner[d] - corners[0][d]));
  }
  return size;
}

bool on_side(const PlanePoint& a, const PlanePoint& b, const PlanePoint& x, double tolerance) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
  if (!(length > 0)) return false;
  const double along = ((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / length;
  const double off = ((x[0] - a[0]) * dy - (x[1] - a[1]) * dx) / length;
  return std::abs(off) <= tolerance && along >= -tolerance && along <= length + tolerance;
}

std::vector<BorderLine> straight_line(const Problem& problem, std::size_t body, const PlanePoint& from,
                                      const PlanePoint& to) {
  const Polygon corners = sides_of(problem.bodies[body]);
  const double tolerance = 1e-9 * size_of(corners);
  const std::vector<char> of_border = edges_of_border(corners);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (!of_border[c]) continue;
    const PlanePoint &a = corners[c], &b = corners[(c + 1) % corners.size()];
    if (on_side(a, b, from, tolerance) && on_side(a, b, to, tolerance))
      return {{.body = body, .from = from, .to = to, .normal = normal_of_edge(a, b)}};
  }
  return {};
}

double length_of(const Polygon& way) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) length += distance(way[k], way[k + 1]);
  return length;
}

// With what the loop encloses on the left.
Polygon way_between(const Polygon& loop, const PlaceOnBorder& from, const PlaceOnBorder& to) {
  const auto along = [&](const PlaceOnBorder& place) { return distance(loop[place.edge], place.at); };
  Polygon way = {from.at};
  const std::size_t n = loop.size();
  std::size_t sides = (to.edge + n - from.edge) % n;
  if (sides == 0 && along(to) < along(from)) sides = n;
  for (std::size_t k = 1; k <= sides; ++k) way.push_back(loop[(from.edge + k) % n]);
  way.push_back(to.at);
  return way;
}

std::vector<BorderLine> lines_along(const Problem& problem, std::size_t body, const PlanePoint& from,
                                    const PlanePoint& to) {
  const PointOutline& outline = problem.bodies[body].outline;
  for (const Polygon& loop : outline.loops) {
    const PlaceOnBorder first = nearest_on_border(loop, from), last = nearest_on_border(loop, to);
    if (!(std::max(first.distance, last.distance) <= outline.spacing)) continue;
    const Polygon there = way_between(loop, first, last), back = way_between(loop, last, first);
    const Polygon& way = length_of(there) <= length_of(back) ? there : back;
    constexpr double rounding = 1e-9;
    std::vector<BorderLine> lines;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
      if (distance(way[k], way[k + 1]) <= rounding * outline.spacing) continue;
      lines.push_back({.body = body, .from = way[k], .to = way[k + 1], .normal = normal_of_edge(way[k], way[k + 1])});
    }
    return lines;
  }
  return {};
}

}  // namespace

BorderLine side_of_box(const Problem& problem, std::size_t body, Face face) {
  const BodySpec& box = problem.bodies[body];
  const auto axis = static_cast<std::size_t>(axis_of(face));
  BorderLine line{.body = body, .from = {box.min[0], box.min[1]}, .to = {box.max[0], box.max[1]}, .normal = {}};
  line.from[axis] = line.to[axis] = (is_upper(face) ? box.max : box.min)[axis];
  line.normal[axis] = is_upper(face) ? 1 : -1;
  return line;
}

std::vector<BorderLine> whole_border(const Problem& problem, std::size_t body) {
  const BodySpec& spec = problem.bodies[body];
  std::vector<BorderLine> lines;
  const auto add_loop = [&](const Polygon& loop) {
    const std::vector<char> of_border = edges_of_border(loop);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const PlanePoint &a = loop[k], &b = loop[(k + 1) % loop.size()];
      if (of_border[k] && a != b) lines.push_back({.body = body, .from = a, .to = b, .normal = normal_of_edge(a, b)});
    }
  };
  if (spec.file.empty()) {
    add_loop(sides_of(spec));
  } else {
    for (const Polygon& loop : spec.outline.loops) add_loop(loop);
  }
  return lines;
}

std::vector<BorderLine> border_lines(const Problem& problem, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to) {
  std::vector<BorderLine> lines;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const bool from_file = !problem.bodies[k].file.empty();
    std::ranges::copy(from_file ? lines_along(problem, k, from, to) : straight_line(problem, k, from, to),
                      std::back_inserter(lines));
  }
  return lines;
}

std::vector<BorderLine> border_lines(const Problem& problem, const TractionSpec& traction) {
  if (traction.face) return {side_of_box(problem, 0, *traction.face)};
  const auto& ends = traction.line;
  return border_lines(problem, {ends.at(0).at(0), ends[0].at(1)}, {ends.at(1).at(0), ends[1].at(1)});
}

}  // namespace stillpoint

#include "scene/border_line.hpp"

#include <algorithm>
#include <cmath>

#include "scene/outline.hpp"

namespace stillpoint {
namespace {

// Counter-clockwise, so that outwards is to the right of each side; empty if the points come from a file.
Polygon sides_of(const BodySpec& body) {
  if (!body.file.empty()) return {};
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

}  // namespace

BorderLine side_of_box(const Scene& scene, std::size_t body, Face face) {
  const BodySpec& box = scene.bodies[body];
  const auto axis = static_cast<std::size_t>(axis_of(face));
  BorderLine line{.body = body, .from = {box.min[0], box.min[1]}, .to = {box.max[0], box.max[1]}, .normal = {}};
  line.from[axis] = line.to[axis] = (is_upper(face) ? box.max : box.min)[axis];
  line.normal[axis] = is_upper(face) ? 1 : -1;
  return line;
}

std::vector<BorderLine> border_lines(const Scene& scene, const std::array<double, 2>& from,
                                     const std::array<double, 2>& to) {
  std::vector<BorderLine> lines;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const Polygon corners = sides_of(scene.bodies[k]);
    const double tolerance = 1e-9 * size_of(corners);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const PlanePoint &a = corners[c], &b = corners[(c + 1) % corners.size()];
      if (!on_side(a, b, from, tolerance) || !on_side(a, b, to, tolerance)) continue;
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      lines.push_back({.body = k, .from = from, .to = to, .normal = {(b[1] - a[1]) / length, (a[0] - b[0]) / length}});
      break;
    }
  }
  return lines;
}

BorderLine border_line(const Scene& scene, const TractionSpec& traction) {
  if (traction.face) return side_of_box(scene, 0, *traction.face);
  const auto& ends = traction.line;
  return border_lines(scene, {ends.at(0).at(0), ends[0].at(1)}, {ends.at(1).at(0), ends[1].at(1)}).at(0);
}

}  // namespace stillpoint

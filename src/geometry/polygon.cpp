#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace stillpoint {

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

PlanePoint normal_of_edge(const PlanePoint& a, const PlanePoint& b) {
  const double length = distance(a, b);
  return {(b[1] - a[1]) / length, (a[0] - b[0]) / length};
}

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

namespace {

int sign(double value) { return (value > 0) - (value < 0); }

/// True if c, which is collinear with a and b, lies between them.
bool between(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return std::min(a[0], b[0]) <= c[0] && c[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= c[1] &&
         c[1] <= std::max(a[1], b[1]);
}

/// True if the segments ab and cd have a point in common.
bool meet(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  const int abc = sign(turn(a, b, c)), abd = sign(turn(a, b, d));
  const int cda = sign(turn(c, d, a)), cdb = sign(turn(c, d, b));
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

/// True if the edges ab and bc lie on each other.
bool folds_back(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return turn(a, b, c) == 0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) <= 0;
}

/// The part of the polygon where direction · (x_axis − border) ≥ 0.
Polygon clipped(const Polygon& polygon, std::size_t axis, double border, double direction) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double before = direction * (from[axis] - border), after = direction * (to[axis] - border);
    if (before >= 0) kept.push_back(from);
    if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
      PlanePoint crossing;
      crossing[axis] = border;
      crossing[1 - axis] = from[1 - axis] + before / (before - after) * (to[1 - axis] - from[1 - axis]);
      kept.push_back(crossing);
    }
  }
  return kept;
}

/// An edge as a function y(x), from left to right; sign: 1 if the polygon lies below it, −1 above.
struct EdgeOverX {
  double x0, y0, x1, y1, sign;
  double at(double x) const { return y0 + (x - x0) / (x1 - x0) * (y1 - y0); }
};

std::vector<EdgeOverX> edges_over_x(const Polygon& polygon, const PlanePoint& origin) {
  const double turn_sign = signed_area(polygon) > 0 ? 1 : -1;
  std::vector<EdgeOverX> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (a[0] == b[0]) continue;
    const bool rightwards = a[0] < b[0];
    const PlanePoint &left = rightwards ? a : b, &right = rightwards ? b : a;
    edges.push_back({left[0] - origin[0], left[1] - origin[1], right[0] - origin[0], right[1] - origin[1],
                     rightwards ? -turn_sign : turn_sign});
  }
  return edges;
}

/// ∫ min(y_a, y_b) dx over the x that both edges have in common.
double area_below_both(const EdgeOverX& a, const EdgeOverX& b) {
  const double left = std::max(a.x0, b.x0), right = std::min(a.x1, b.x1);
  if (!(right > left)) return 0;
  const double a0 = a.at(left), a1 = a.at(right), b0 = b.at(left), b1 = b.at(right);
  const double width = right - left, d0 = a0 - b0, d1 = a1 - b1;
  if (!(d0 * d1 < 0)) return width * (d0 + d1 < 0 ? a0 + a1 : b0 + b1) / 2;
  const double share = d0 / (d0 - d1), crossing = a0 + share * (a1 - a0);
  return width * (share * (std::min(a0, b0) + crossing) + (1 - share) * (crossing + std::min(a1, b1))) / 2;
}

}  // namespace

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) twice += turn(polygon[0], polygon[k - 1], polygon[k]);
  return twice / 2;
}

std::vector<char> edges_of_border(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  std::set<std::pair<PlanePoint, PlanePoint>> edges;
  for (std::size_t k = 0; k < n; ++k) edges.emplace(polygon[k], polygon[(k + 1) % n]);
  std::vector<char> of_border(n);
  for (std::size_t k = 0; k < n; ++k) of_border[k] = edges.contains({polygon[(k + 1) % n], polygon[k]}) ? 0 : 1;
  return of_border;
}

Polygon without_straight_corners(const Polygon& polygon) {
  constexpr double rounding = 1e-9;
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &before = kept.empty() ? polygon.back() : kept.back(), &after = polygon[(k + 1) % polygon.size()];
    const double size = distance(before, polygon[k]) * distance(polygon[k], after);
    if (std::abs(turn(before, polygon[k], after)) > rounding * size) kept.push_back(polygon[k]);
  }
  return kept;
}

PlanePoint centroid(const Polygon& polygon) {
  // The mean over the triangles between corner 0 and each edge, relative to corner 0.
  double twice = 0;
  PlanePoint moment{0, 0};
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const double area = turn(polygon[0], polygon[k - 1], polygon[k]);
    twice += area;
    for (std::size_t d = 0; d < 2; ++d) moment[d] += area * (polygon[k - 1][d] + polygon[k][d] - 2 * polygon[0][d]) / 3;
  }
  return {polygon[0][0] + moment[0] / twice, polygon[0][1] + moment[1] / twice};
}

bool contains(const Polygon& polygon, const PlanePoint& x) {
  // A point is inside if the ray from it to the right crosses the border an odd number of times.
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[1] > x[1]) == (b[1] > x[1])) continue;
    const bool left_of_edge = b[1] > a[1] ? turn(a, b, x) > 0 : turn(b, a, x) > 0;
    if (left_of_edge) inside = !inside;
  }
  return inside;
}

Polygon clipped_to_unit_square(const Polygon& polygon) {
  Polygon part = polygon;
  for (std::size_t axis = 0; axis < 2; ++axis) part = clipped(clipped(part, axis, 0, 1), axis, 1, -1);
  return part;
}

// A polygon is the sum of the regions below its edges, positive for upper edges and negative for lower ones. So is its
// characteristic function, and the product of two of them is a sum over pairs of edges.
double overlap_area(const Polygon& a, const Polygon& b) {
  const PlanePoint& origin = a.front();
  const std::vector<EdgeOverX> of_b = edges_over_x(b, origin);
  double area = 0;
  for (const EdgeOverX& one : edges_over_x(a, origin)) {
    for (const EdgeOverX& other : of_b) area += one.sign * other.sign * area_below_both(one, other);
  }
  return area;
}

PlaceOnBorder nearest_on_border(const Polygon& polygon, const PlanePoint& x) {
  PlaceOnBorder nearest{.distance = std::numeric_limits<double>::infinity(), .edge = 0, .at = {}};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double along = ((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / (dx * dx + dy * dy);
    const double share = std::clamp(along, 0.0, 1.0);
    const PlanePoint at{a[0] + share * dx, a[1] + share * dy};
    if (const double away = distance(x, at); away < nearest.distance) nearest = {away, k, at};
  }
  return nearest;
}

std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % n];
    if (folds_back(a, b, polygon[(k + 2) % n])) return std::pair(k, (k + 1) % n);
    for (std::size_t j = k + 2; j < n && !(k == 0 && j == n - 1); ++j)
      if (meet(a, b, polygon[j], polygon[(j + 1) % n])) return std::pair(k, j);
  }
  return std::nullopt;
}

// By lines from the middles of parts of the edges, inwards along their normals, to what they meet first.
double thinnest_part(const Polygon& polygon) {
  constexpr int looks = 16;           // along an edge
  constexpr double opposite = -0.85;  // the cosine between normals
  const double inwards = signed_area(polygon) > 0 ? -1 : 1;
  const std::size_t n = polygon.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % n];
    if (a == b) continue;
    const PlanePoint normal = normal_of_edge(a, b), d{inwards * normal[0], inwards * normal[1]};
    for (int look = 0; look < looks; ++look) {
      const double share = (look + 0.5) / looks;
      const PlanePoint x{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
      double way = std::numeric_limits<double>::infinity(), facing = 1;
      for (std::size_t l = 0; l < n; ++l) {
        const PlanePoint &from = polygon[l], &to = polygon[(l + 1) % n];
        if (l == k || from == to) continue;
        // x + s d = from + r (to − from)
        const double ex = to[0] - from[0], ey = to[1] - from[1], det = ex * d[1] - ey * d[0];
        const double rx = x[0] - from[0], ry = x[1] - from[1];
        const double s = (ey * rx - ex * ry) / det, r = (d[1] * rx - d[0] * ry) / det;
        if (!(s > 0 && s < way && r >= 0 && r <= 1)) continue;
        way = s;
        const PlanePoint other = normal_of_edge(from, to);
        facing = normal[0] * other[0] + normal[1] * other[1];
      }
      if (facing < opposite) least = std::min(least, way);
    }
  }
  return least;
}

}  // namespace stillpoint

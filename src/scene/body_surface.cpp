#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/gauss_rule.hpp"
#include "geometry/polygon_rule.hpp"
#include "geometry/prism.hpp"
#include "scene/body_border.hpp"
#include "scene/body_solid.hpp"

namespace stillpoint {
namespace {

using Eigen::Vector3d;

constexpr int kDegree = 3;  // the degree of the rule of a piece along each of its sides
constexpr double kQuarter = std::numbers::pi / 2;

Vector3d vector_at(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }

class PieceCollector {
 public:
  PieceCollector(const BodySpec& body, double length) : body_(body), length_(length), box_(box_of(body)) {
    for (std::size_t d = 0; d < 3; ++d) slack_ = std::max(slack_, 1e-9 * (box_.high[d] - box_.low[d]));
  }
  const BodySpec& body() const { return body_; }
  const SpaceBox& box() const { return box_; }
  double length() const { return length_; }
  int parts_of(double length) const { return std::max(1, static_cast<int>(std::ceil(length / length_))); }

  void add(const Vector3d& x, const Vector3d& vector) {
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      if (x[d] < box_.low[axis] - slack_ || x[d] > box_.high[axis] + slack_) return;
    }
    pieces_.push_back({{x[0], x[1], x[2]}, {vector[0], vector[1], vector[2]}});
  }
  /// visit(position, weight) along an interval in so many parts.
  template <class Visit>
  static void along(double from, double to, int parts, const Visit& visit) {
    static const UnitRule rule(kDegree);
    for (int part = 0; part < parts; ++part)
      for (std::size_t k = 0; k < rule.at.size(); ++k)
        visit(from + (to - from) * (part + rule.at[k]) / parts, rule.weight[k] * (to - from) / parts);
  }
  std::vector<SurfacePiece> take() { return std::move(pieces_); }

 private:
  const BodySpec& body_;
  double length_;
  SpaceBox box_;
  double slack_ = 0;
  std::vector<SurfacePiece> pieces_;
};

// x = c + R n,  n = (sin θ cos φ, sin θ sin φ, cos θ),  dA = R² sin θ dθ dφ, by eighths
void add_sphere(PieceCollector& pieces, double R, double outwards) {
  const Vector3d centre = vector_at(pieces.body().sphere);
  for (int eighth = 0; eighth < 8; ++eighth) {
    const Vector3d sign((eighth & 1) != 0 ? -1 : 1, (eighth & 2) != 0 ? -1 : 1, (eighth & 4) != 0 ? -1 : 1);
    pieces.along(0, kQuarter, pieces.parts_of(kQuarter * R), [&](double theta, double of_theta) {
      const double r = R * std::sin(theta);
      pieces.along(0, kQuarter, pieces.parts_of(kQuarter * r), [&](double phi, double of_phi) {
        const Vector3d n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        const Vector3d normal = n.cwiseProduct(sign);
        pieces.add(centre + R * normal, outwards * R * r * of_theta * of_phi * normal);
      });
    });
  }
}

/// visit(direction across the axis, weight [rad]) in quarters; the first begins at an axis of coordinates, if the
/// cylinder stands along another.
template <class Visit>
void for_directions(const PieceCollector& pieces, const Vector3d& a, double radius, const Visit& visit) {
  int across = 0;
  a.cwiseAbs().minCoeff(&across);
  const Vector3d first = (Vector3d::Unit(across) - a[across] * a).normalized(), second = a.cross(first);
  for (int quarter = 0; quarter < 4; ++quarter) {
    PieceCollector::along(
        quarter * kQuarter, (quarter + 1) * kQuarter, pieces.parts_of(kQuarter * radius),
        [&](double phi, double weight) { visit(Vector3d(std::cos(phi) * first + std::sin(phi) * second), weight); });
  }
}

void add_cylinder(PieceCollector& pieces, BodySurface surface) {
  const BodySpec& body = pieces.body();
  const Vector3d from = vector_at(body.cylinder[0]), to = vector_at(body.cylinder[1]);
  const double length = (to - from).norm();
  const Vector3d a = (to - from) / length;
  if (surface == BodySurface::outer || surface == BodySurface::inner) {
    const bool outer = surface == BodySurface::outer;
    const double R = outer ? body.radius : body.inner_radius;
    for_directions(pieces, a, R, [&](const Vector3d& n, double of_angle) {
      PieceCollector::along(0, length, pieces.parts_of(length), [&](double s, double of_length) {
        pieces.add(from + s * a + R * n, (outer ? 1 : -1) * R * of_angle * of_length * n);
      });
    });
    return;
  }
  const bool at_end = surface == BodySurface::end;
  PieceCollector::along(body.inner_radius, body.radius, pieces.parts_of(body.radius - body.inner_radius),
                        [&](double r, double of_radius) {
                          for_directions(pieces, a, r, [&](const Vector3d& n, double of_angle) {
                            pieces.add((at_end ? to : from) + r * n, (at_end ? 1 : -1) * r * of_angle * of_radius * a);
                          });
                        });
}

/// The part of an edge between borders, from its share first to its share last.
bool clip(double from, double to, double low, double high, double& first, double& last) {
  if (from == to) return from >= low && from <= high;
  const double a = (low - from) / (to - from), b = (high - from) / (to - from);
  first = std::max(first, std::min(a, b));
  last = std::min(last, std::max(a, b));
  return first < last;
}

void add_sides_of_prism(PieceCollector& pieces) {
  const BodySpec& body = pieces.body();
  const SpaceBox& box = pieces.box();
  const auto axis = static_cast<std::size_t>(body.axis);
  const std::size_t i = across(axis)[0], j = across(axis)[1];
  Polygon polygon = outline_of(body);
  if (signed_area(polygon) < 0) std::ranges::reverse(polygon);
  const double height = box.high[axis] - box.low[axis];
  const std::vector<char> of_border = edges_of_border(polygon);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (!of_border[k]) continue;
    const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    double first = 0, last = 1;
    if (!clip(a[0], b[0], box.low[i], box.high[i], first, last)) continue;
    if (!clip(a[1], b[1], box.low[j], box.high[j], first, last)) continue;
    const double length = distance(a, b);
    const PlanePoint n = normal_of_edge(a, b);
    PieceCollector::along(first, last, pieces.parts_of((last - first) * length), [&](double s, double of_edge) {
      PieceCollector::along(box.low[axis], box.high[axis], pieces.parts_of(height), [&](double z, double of_height) {
        Vector3d x, vector = Vector3d::Zero();
        x[static_cast<int>(axis)] = z;
        x[static_cast<int>(i)] = std::lerp(a[0], b[0], s);
        x[static_cast<int>(j)] = std::lerp(a[1], b[1], s);
        vector[static_cast<int>(i)] = n[0] * of_edge * length * of_height;
        vector[static_cast<int>(j)] = n[1] * of_edge * length * of_height;
        pieces.add(x, vector);
      });
    });
  }
}

void add_end_of_prism(PieceCollector& pieces, bool at_end) {
  const BodySpec& body = pieces.body();
  const SpaceBox& box = pieces.box();
  const auto axis = static_cast<std::size_t>(body.axis);
  const std::size_t i = across(axis)[0], j = across(axis)[1];
  const int columns = pieces.parts_of(box.high[i] - box.low[i]), rows = pieces.parts_of(box.high[j] - box.low[j]);
  const double width = (box.high[i] - box.low[i]) / columns, depth = (box.high[j] - box.low[j]) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double left = box.low[i] + column * width, low = box.low[j] + row * depth;
      Polygon local;
      for (const PlanePoint& corner : outline_of(body))
        local.push_back({(corner[0] - left) / width, (corner[1] - low) / depth});
      const Polygon part = clipped_to_unit_square(local);
      const double area = part.size() < 3 ? 0 : std::abs(signed_area(part));
      if (!(area > 1e-12)) continue;
      const PlaneRule rule = polygon_rule(part, kDegree);
      for (std::size_t q = 0; q < rule.x.size(); ++q) {
        Vector3d x, vector = Vector3d::Zero();
        x[static_cast<int>(axis)] = (at_end ? box.high : box.low)[axis];
        x[static_cast<int>(i)] = left + rule.x[q][0] * width;
        x[static_cast<int>(j)] = low + rule.x[q][1] * depth;
        vector[static_cast<int>(axis)] = (at_end ? 1 : -1) * rule.share[q] * area * width * depth;
        pieces.add(x, vector);
      }
    }
  }
}

/// Each triangle in n² alike, with a rule for polynomials of degree 2.
void add_triangles(PieceCollector& pieces) {
  const std::shared_ptr<const TriangleSolid> solid = stl_solid(pieces.body());
  for (const Facet& t : solid->triangles()) {
    const Vector3d a(t[0].data()), b(t[1].data()), c(t[2].data());
    const int n = pieces.parts_of(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}));
    const Vector3d u = (b - a) / n, v = (c - a) / n, vector = u.cross(v) / 6;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        for (const bool turned : {false, true}) {
          if (turned && i + j + 1 == n) continue;
          const Vector3d corner = turned ? Vector3d(a + (i + 1) * u + (j + 1) * v) : Vector3d(a + i * u + j * v);
          const double sign = turned ? -1 : 1;
          for (const auto& [s, r] : {std::pair(1.0 / 6, 1.0 / 6), {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}})
            pieces.add(corner + sign * (s * u + r * v), vector);
        }
      }
    }
  }
}

}  // namespace

std::vector<SurfacePiece> surface_pieces(const BodySpec& body, BodySurface surface, double length) {
  PieceCollector pieces(body, length);
  const bool outer = surface == BodySurface::outer;
  switch (body.shape()) {
    case BodyShape::polygon:
      outer ? add_sides_of_prism(pieces) : add_end_of_prism(pieces, surface == BodySurface::end);
      break;
    case BodyShape::sphere:
      add_sphere(pieces, outer ? body.radius : body.inner_radius, outer ? 1 : -1);
      break;
    case BodyShape::cylinder:
      add_cylinder(pieces, surface);
      break;
    case BodyShape::triangles:
      add_triangles(pieces);
      break;
    case BodyShape::box:
    case BodyShape::points:
      break;
  }
  return pieces.take();
}

std::string why_no_surface(const BodySpec& body, BodySurface surface) {
  if (surface == BodySurface::outer) return "";
  if (surface == BodySurface::inner)
    return body.inner_radius > 0 ? "" : "a hollow sphere or cylinder has an inner surface, with an inner_radius";
  const bool has_ends = body.shape() == BodyShape::cylinder || body.shape() == BodyShape::polygon;
  return has_ends ? "" : "a cylinder or a polygon that is drawn out has two ends";
}

std::optional<std::size_t> body_with_surface(const Problem& problem) {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    if (!problem.bodies[k].has_shape()) continue;
    if (found) return std::nullopt;
    found = k;
  }
  return found;
}

}  // namespace stillpoint

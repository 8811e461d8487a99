#include "geometry/triangle_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "geometry/box_tree.hpp"
#include "geometry/gauss_rule.hpp"

namespace stillpoint {
namespace {

/// The winding of a triangle's projection along x about (y, z): 1 if its normal points to greater x, −1 if to smaller
/// x, 0 if (y, z) is outside. An edge is always evaluated from its lower end, so that both of its triangles agree.
int orientation_about(const Facet& triangle, double y, double z) {
  int winding = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const SpacePoint &from = triangle[k], &to = triangle[(k + 1) % 3];
    if ((from[2] > z) == (to[2] > z)) continue;
    const bool upwards = to[2] > from[2];
    const SpacePoint &low = upwards ? from : to, &high = upwards ? to : from;
    const double side = (high[1] - low[1]) * (z - low[2]) - (high[2] - low[2]) * (y - low[1]);
    if (side > 0) winding += upwards ? 1 : -1;  // the edge passes on the side of greater y
  }
  return winding;
}

/// The x of the triangle's plane at (y, z), limited to the range of the triangle.
double x_at(const Facet& t, double y, double z) {
  const double y1 = t[1][1] - t[0][1], z1 = t[1][2] - t[0][2], y2 = t[2][1] - t[0][1], z2 = t[2][2] - t[0][2];
  const double area = y1 * z2 - y2 * z1;
  const double a = ((y - t[0][1]) * z2 - y2 * (z - t[0][2])) / area;
  const double b = (y1 * (z - t[0][2]) - (y - t[0][1]) * z1) / area;
  const auto [low, high] = std::minmax({t[0][0], t[1][0], t[2][0]});
  const double x = t[0][0] + a * (t[1][0] - t[0][0]) + b * (t[2][0] - t[0][0]);
  return std::isfinite(x) ? std::clamp(x, low, high) : low;
}

using FacetPart = std::vector<SpacePoint>;

/// The part of the face where direction · (x_axis − border) ≥ 0.
FacetPart cut(const FacetPart& face, std::size_t axis, double border, double direction) {
  FacetPart kept;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const SpacePoint &from = face[k], &to = face[(k + 1) % face.size()];
    const double before = direction * (from[axis] - border), after = direction * (to[axis] - border);
    if (before >= 0) kept.push_back(from);
    if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
      SpacePoint crossing;
      for (std::size_t d = 0; d < 3; ++d) crossing[d] = from[d] + before / (before - after) * (to[d] - from[d]);
      crossing[axis] = border;
      kept.push_back(crossing);
    }
  }
  return kept;
}

/// A rule for columns along x below faces: from x_low to the face, or to a given height.
class ColumnRule {
 public:
  ColumnRule(double x_low, int degree) : x_low_(x_low), along_(degree), across_(degree + 2) {}

  void add(const FacetPart& face, std::optional<double> x_high) {
    for (std::size_t k = 1; k + 1 < face.size(); ++k) add(Facet{face[0], face[k], face[k + 1]}, x_high);
  }
  SpaceRule take() { return std::move(rule_); }

 private:
  // Points (1 − s) a + s ((1 − t) b + t c), s and t in [0, 1], with the area element 2 A s ds dt.
  void add(const Facet& t, std::optional<double> x_high) {
    const double area = (t[1][1] - t[0][1]) * (t[2][2] - t[0][2]) - (t[2][1] - t[0][1]) * (t[1][2] - t[0][2]);
    if (area == 0) return;
    for (std::size_t i = 0; i < across_.at.size(); ++i) {
      for (std::size_t j = 0; j < across_.at.size(); ++j) {
        const double s = across_.at[i];
        SpacePoint x;
        for (std::size_t d = 0; d < 3; ++d) x[d] = std::lerp(t[0][d], std::lerp(t[1][d], t[2][d], across_.at[j]), s);
        const double top = x_high.value_or(x[0]), weight = across_.weight[i] * across_.weight[j] * s * area;
        for (std::size_t k = 0; k < along_.at.size(); ++k) {
          x[0] = std::lerp(x_low_, top, along_.at[k]);
          rule_.x.push_back(x);
          rule_.weight.push_back(weight * along_.weight[k] * (top - x_low_));
        }
      }
    }
  }

  double x_low_;
  UnitRule along_, across_;
  SpaceRule rule_;
};

bool meet(const SpaceBox& a, const SpaceBox& b, std::size_t axis) {
  return a.low[axis] <= b.high[axis] && a.high[axis] >= b.low[axis];
}

}  // namespace

std::optional<OpenEdge> open_edge(const std::vector<Facet>& triangles) {
  std::map<std::pair<SpacePoint, SpacePoint>, int> passed;  // passages upwards less those downwards
  for (const Facet& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const SpacePoint &from = triangle[k], &to = triangle[(k + 1) % 3];
      if (from < to) ++passed[{from, to}];
      if (to < from) --passed[{to, from}];
    }
  }
  for (const auto& [edge, count] : passed)
    if (count != 0) return OpenEdge{edge.first, edge.second};
  return std::nullopt;
}

// ⅙ Σ a · (b × c), with positions relative to a nearby one
double signed_volume(const std::vector<Facet>& triangles) {
  double sum = 0;
  for (const Facet& triangle : triangles) {
    std::array<SpacePoint, 3> r = triangle;
    for (SpacePoint& x : r)
      for (std::size_t d = 0; d < 3; ++d) x[d] -= triangles[0][0][d];
    const auto& [a, b, c] = r;
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

TriangleSolid::TriangleSolid(std::vector<Facet> triangles) : triangles_(std::move(triangles)) {
  if (signed_volume(triangles_) < 0)
    for (Facet& triangle : triangles_) std::swap(triangle[1], triangle[2]);
  bounds_ = box_around(triangles_.front());
  for (const Facet& triangle : triangles_) {
    const SpaceBox& box = boxes_.emplace_back(box_around(triangle));
    for (std::size_t d = 0; d < 3; ++d) {
      bounds_.low[d] = std::min(bounds_.low[d], box.low[d]);
      bounds_.high[d] = std::max(bounds_.high[d], box.high[d]);
    }
  }
  constexpr double most_bins = 512;
  bins_ = static_cast<int>(std::clamp(std::sqrt(static_cast<double>(triangles_.size())), 1.0, most_bins));
  bin_.resize(static_cast<std::size_t>(bins_ * bins_));
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto low = bin_of(boxes_[t].low[1], boxes_[t].low[2]), high = bin_of(boxes_[t].high[1], boxes_[t].high[2]);
    for (int k = low[1]; k <= high[1]; ++k)
      for (int j = low[0]; j <= high[0]; ++j)
        bin_[static_cast<std::size_t>(k * bins_ + j)].push_back(static_cast<int>(t));
  }
}

std::array<int, 2> TriangleSolid::bin_of(double y, double z) const {
  const auto along = [&](double at, std::size_t d) {
    const double share = (at - bounds_.low[d]) / (bounds_.high[d] - bounds_.low[d]);
    return static_cast<int>(std::clamp(share * bins_, 0.0, bins_ - 1.0));
  };
  return {along(y, 1), along(z, 2)};
}

std::vector<int> TriangleSolid::in_column(const SpaceBox& box) const {
  std::vector<int> found;
  const auto low = bin_of(box.low[1], box.low[2]), high = bin_of(box.high[1], box.high[2]);
  for (int k = low[1]; k <= high[1]; ++k) {
    for (int j = low[0]; j <= high[0]; ++j) {
      for (const int t : bin_[static_cast<std::size_t>(k * bins_ + j)]) {
        const SpaceBox& of_triangle = boxes_[static_cast<std::size_t>(t)];
        if (meet(of_triangle, box, 1) && meet(of_triangle, box, 2)) found.push_back(t);
      }
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool TriangleSolid::contains(const SpacePoint& x) const {
  for (std::size_t d = 0; d < 3; ++d)
    if (x[d] < bounds_.low[d] || x[d] > bounds_.high[d]) return false;
  int left = 0;
  const auto bin = bin_of(x[1], x[2]);
  for (const int t : bin_[static_cast<std::size_t>(bin[1] * bins_ + bin[0])]) {
    const Facet& triangle = triangles_[static_cast<std::size_t>(t)];
    if (boxes_[static_cast<std::size_t>(t)].high[0] <= x[0]) continue;
    const int orientation = orientation_about(triangle, x[1], x[2]);
    if (orientation != 0 && x_at(triangle, x[1], x[2]) > x[0]) left += orientation;
  }
  return left > 0;
}

Solid::Part TriangleSolid::part_of(const SpaceBox& box) const {
  for (std::size_t d = 0; d < 3; ++d)
    if (!meet(bounds_, box, d)) return Part::none;
  for (const int t : in_column(box))
    if (meet(boxes_[static_cast<std::size_t>(t)], box, 0)) return Part::some;
  return contains(box.middle()) ? Part::all : Part::none;
}

SpaceRule TriangleSolid::rule(const SpaceBox& box, int degree) const {
  ColumnRule rule(box.low[0], degree);
  for (const int t : in_column(box)) {
    if (boxes_[static_cast<std::size_t>(t)].high[0] <= box.low[0]) continue;
    const Facet& triangle = triangles_[static_cast<std::size_t>(t)];
    FacetPart face(triangle.begin(), triangle.end());
    for (std::size_t d = 1; d < 3; ++d) face = cut(cut(face, d, box.low[d], 1), d, box.high[d], -1);
    face = cut(face, 0, box.low[0], 1);
    const bool reaches_beyond = std::ranges::any_of(face, [&](const SpacePoint& x) { return x[0] > box.high[0]; });
    rule.add(cut(face, 0, box.high[0], -1), std::nullopt);
    if (reaches_beyond) rule.add(cut(face, 0, box.high[0], 1), box.high[0]);
  }
  return rule.take();
}

}  // namespace stillpoint

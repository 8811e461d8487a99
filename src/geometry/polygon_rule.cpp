#include "geometry/polygon_rule.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/gauss_rule.hpp"

namespace stillpoint {
namespace {

/// The part of an edge between two verticals.
struct Chord {
  double at_left, at_right;  // y
  double middle() const { return at_left + at_right; }
};

/// The chords of the polygon between two verticals, from below to above; edges of a polygon meet at corners only.
std::vector<Chord> chords_between(const Polygon& polygon, double left, double right) {
  std::vector<Chord> chords;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const PlanePoint &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const PlanePoint &a = from[0] < to[0] ? from : to, &b = from[0] < to[0] ? to : from;
    if (a[0] > left || b[0] < right) continue;
    const double width = b[0] - a[0];
    chords.push_back({std::lerp(a[1], b[1], (left - a[0]) / width), std::lerp(a[1], b[1], (right - a[0]) / width)});
  }
  std::ranges::sort(chords, {}, &Chord::middle);
  return chords;
}

}  // namespace

PlaneRule polygon_rule(const Polygon& polygon, int degree) {
  std::vector<double> verticals;
  for (const PlanePoint& corner : polygon) verticals.push_back(corner[0]);
  std::ranges::sort(verticals);
  verticals.erase(std::unique(verticals.begin(), verticals.end()), verticals.end());

  const UnitRule along_x(degree + 1), along_y(degree);
  PlaneRule rule;
  for (std::size_t k = 0; k + 1 < verticals.size(); ++k) {
    const double left = verticals[k], right = verticals[k + 1];
    // The region between an odd chord and the next is inside; a border that is run through both ways gives two
    // coincident chords.
    const std::vector<Chord> chords = chords_between(polygon, left, right);
    for (std::size_t c = 0; c + 1 < chords.size(); c += 2) {
      const Chord &lower = chords[c], &upper = chords[c + 1];
      for (std::size_t i = 0; i < along_x.at.size(); ++i) {
        const double s = along_x.at[i];
        const double from = std::lerp(lower.at_left, lower.at_right, s),
                     to = std::lerp(upper.at_left, upper.at_right, s);
        const double width = along_x.weight[i] * (right - left);
        if (!(width * (to - from) > 0)) continue;
        for (std::size_t j = 0; j < along_y.at.size(); ++j) {
          rule.x.push_back({std::lerp(left, right, s), std::lerp(from, to, along_y.at[j])});
          rule.share.push_back(width * along_y.weight[j] * (to - from));
        }
      }
    }
  }
  const double area = std::accumulate(rule.share.begin(), rule.share.end(), 0.0);
  for (double& share : rule.share) share /= area;
  return rule;
}

}  // namespace stillpoint

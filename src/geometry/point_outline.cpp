#include "geometry/point_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <utility>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace stillpoint {
namespace {

using Triangle = std::array<std::size_t, 3>;
using Loop = std::vector<std::size_t>;  // numbers of points

// The state of Qhull while it works.
class Qhull {
 public:
  Qhull() {
    if (!log_) throw std::runtime_error("no temporary file for the messages of Qhull");
    qh_zero(&state_, log_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    qh_freeqhull(&state_, !qh_ALL);
    int kept = 0, total = 0;
    qh_memfreeshort(&state_, &kept, &total);
    std::fclose(log_);
  }

  /// Counter-clockwise; none if the points lie on a line.
  std::vector<Triangle> delaunay(const std::vector<PlanePoint>& points) {
    std::vector<double> coordinates;
    for (const PlanePoint& point : points) coordinates.insert(coordinates.end(), point.begin(), point.end());
    // Qt: of points on one circle triangles as well; Qbb, Qc, Qz: for points on a lattice
    std::array<char, 32> command = {"qhull d Qt Qbb Qc Qz"};
    const int failed = qh_new_qhull(&state_, 2, static_cast<int>(points.size()), coordinates.data(), False,
                                    command.data(), nullptr, log_);
    std::vector<Triangle> triangles;
    if (failed != 0) return triangles;
    qhT* const qh = &state_;  // which its macros name
    for (facetT* facet = qh->facet_list; facet && facet->next; facet = facet->next) {
      if (facet->upperdelaunay != 0) continue;
      Triangle corners{};
      for (int k = 0; k < 3; ++k) {
        const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[k].p);
        corners[static_cast<std::size_t>(k)] = static_cast<std::size_t>(qh_pointid(qh, vertex->point));
      }
      if (turn(points[corners[0]], points[corners[1]], points[corners[2]]) < 0) std::swap(corners[1], corners[2]);
      triangles.push_back(corners);
    }
    return triangles;
  }

 private:
  qhT state_{};
  std::FILE* log_ = std::tmpfile();
};

// R = abc/(4 A)
double radius(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return distance(a, b) * distance(b, c) * distance(c, a) / (2 * turn(a, b, c));
}

// Edges of one triangle alone, each from its start to its ends.
std::multimap<std::size_t, std::size_t> border_edges(const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::size_t, std::size_t>, bool> edges;  // an edge, and true if its other side has no triangle
  for (const Triangle& corners : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::pair edge(corners[k], corners[(k + 1) % 3]);
      const auto twin = edges.find({edge.second, edge.first});
      edges[edge] = twin == edges.end();
      if (twin != edges.end()) twin->second = false;
    }
  }
  std::multimap<std::size_t, std::size_t> border;
  for (const auto& [edge, alone] : edges)
    if (alone) border.insert(edge);
  return border;
}

// If loops touch in a point, either continuation closes both.
std::vector<Loop> loops_of(std::multimap<std::size_t, std::size_t> border) {
  std::vector<Loop> loops;
  while (!border.empty()) {
    Loop loop;
    for (auto edge = border.begin(); edge != border.end(); edge = border.find(loop.back())) {
      const std::size_t to = edge->second;
      border.erase(edge);
      loop.push_back(to);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

// Corner k of a loop moves so that both its edges go outwards, which is to their right, by `by`.
PlanePoint moved_out(const Polygon& loop, std::size_t k, double by) {
  const PlanePoint &before = loop[(k + loop.size() - 1) % loop.size()], &here = loop[k],
                   &after = loop[(k + 1) % loop.size()];
  const PlanePoint n = normal_of_edge(before, here), m = normal_of_edge(here, after);
  constexpr double sharpest = 0.3;  // a spike goes no farther than that of 45° would
  const double share = by / std::max(1 + n[0] * m[0] + n[1] * m[1], sharpest);
  return {here[0] + share * (n[0] + m[0]), here[1] + share * (n[1] + m[1])};
}

}  // namespace

std::vector<Polygon> outline_of_points(const std::vector<double>& x, const std::vector<double>& y,
                                       const std::vector<double>& area) {
  std::vector<PlanePoint> points;
  for (std::size_t p = 0; p < x.size(); ++p) points.push_back({x[p], y[p]});
  if (points.size() < 3) return {};
  const auto spacing = [&](std::size_t p) { return std::sqrt(area[p]); };

  std::vector<Triangle> triangles = Qhull().delaunay(points);
  std::erase_if(triangles, [&](const Triangle& t) {
    const double widest = (spacing(t[0]) + spacing(t[1]) + spacing(t[2])) / 2;
    return !(turn(points[t[0]], points[t[1]], points[t[2]]) > 0) ||
           !(radius(points[t[0]], points[t[1]], points[t[2]]) <= widest);
  });
  std::vector<Polygon> outline;
  for (const Loop& loop : loops_of(border_edges(triangles))) {
    Polygon corners, moved;
    for (const std::size_t p : loop) corners.push_back(points[p]);
    for (std::size_t k = 0; k < loop.size(); ++k) moved.push_back(moved_out(corners, k, spacing(loop[k]) / 2));
    outline.push_back(std::move(moved));
  }
  for (Polygon& loop : outline) loop = without_straight_corners(loop);
  std::erase_if(outline, [](const Polygon& loop) { return loop.size() < 3; });
  return outline;
}

}  // namespace stillpoint

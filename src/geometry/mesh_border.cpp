#include "geometry/mesh_border.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace stillpoint {
namespace {

using Node = std::size_t;
using Nodes = std::vector<Node>;

// --- in the plane ---

/// The nodes around an element, those in the middle of its sides among them, by their numbers in the element.
std::span<const std::size_t> ring_of(int kind) {
  static constexpr std::array<std::size_t, 3> triangle{0, 1, 2};
  static constexpr std::array<std::size_t, 4> quadrilateral{0, 1, 2, 3};
  static constexpr std::array<std::size_t, 6> triangle_2{0, 3, 1, 4, 2, 5};
  static constexpr std::array<std::size_t, 8> quadrilateral_2{0, 4, 1, 5, 2, 6, 3, 7};
  return kind == 2   ? std::span<const std::size_t>(triangle)
         : kind == 3 ? std::span<const std::size_t>(quadrilateral)
         : kind == 9 ? std::span<const std::size_t>(triangle_2)
                     : std::span<const std::size_t>(quadrilateral_2);
}

PlanePoint in_plane(const SpacePoint& x) { return {x[0], x[1]}; }

/// The nodes around an element, counter-clockwise.
Nodes around(const Mesh& mesh, const MeshElement& element) {
  Nodes ring;
  Polygon corners;
  for (const std::size_t k : ring_of(element.kind)) {
    ring.push_back(element.nodes[k]);
    corners.push_back(in_plane(mesh.nodes.at(ring.back())));
  }
  if (signed_area(corners) < 0) std::ranges::reverse(ring);
  return ring;
}

/// The sides of elements that have no other element across.
std::multimap<Node, Node> open_sides(const Mesh& mesh, std::string& fault) {
  std::map<std::pair<Node, Node>, int> sides;
  for (const MeshElement& element : mesh.elements) {
    const Nodes ring = around(mesh, element);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::pair side(ring[k], ring[(k + 1) % ring.size()]);
      if (++sides[side] == 1) continue;
      const SpacePoint& x = mesh.nodes.at(side.first);
      fault = fmt::format("elements lie in each other at ({:.6g}, {:.6g})", x[0], x[1]);
      return {};
    }
  }
  std::multimap<Node, Node> open;
  for (const auto& [side, count] : sides)
    if (!sides.contains({side.second, side.first})) open.insert(side);
  return open;
}

// --- in space ---

/// A face of an element, seen from outside counter-clockwise if the element is not inside out: its corners, and of
/// elements of order 2 the nodes in the middle of the edges behind them.
using ElementFace = std::vector<std::size_t>;

std::vector<ElementFace> faces_of(int kind) {
  switch (kind) {
    case 5:
      return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    case 6:
      return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    case 7:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    case 11:
      return {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 9, 7}, {0, 3, 2, 7, 8, 6}, {1, 2, 3, 5, 8, 9}};
    default:
      return {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  }
}

/// The triangles of a face, by the numbers of its nodes in the face.
std::span<const std::array<std::size_t, 3>> triangles_of(std::size_t nodes) {
  static constexpr std::array<std::array<std::size_t, 3>, 4> all{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  static constexpr std::array<std::array<std::size_t, 3>, 2> of_four{{{0, 1, 2}, {0, 2, 3}}};
  static constexpr std::array<std::array<std::size_t, 3>, 1> of_three{{{0, 1, 2}}};
  if (nodes == 3) return of_three;
  if (nodes == 4) return of_four;
  return all;
}

void add_triangles(const Mesh& mesh, const Nodes& face, std::vector<Facet>& facets) {
  for (const auto& [a, b, c] : triangles_of(face.size()))
    facets.push_back({mesh.nodes.at(face[a]), mesh.nodes.at(face[b]), mesh.nodes.at(face[c])});
}

std::vector<Nodes> faces_outwards(const Mesh& mesh, const MeshElement& element) {
  std::vector<Nodes> faces;
  std::vector<Facet> facets;
  for (const ElementFace& face : faces_of(element.kind)) {
    Nodes& nodes = faces.emplace_back();
    for (const std::size_t k : face) nodes.push_back(element.nodes[k]);
    add_triangles(mesh, nodes, facets);
  }
  if (signed_volume(facets) >= 0) return faces;
  for (Nodes& face : faces) {
    const auto corners = static_cast<std::ptrdiff_t>(face.size() == 6 ? 3 : face.size());
    std::reverse(face.begin(), face.begin() + corners);
    if (face.size() == 6) std::swap(face[3], face[4]);  // between the corners 2 and 1, 1 and 0, 0 and 2
  }
  return faces;
}

// --- bridges between loops ---

bool crosses(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d) {
  if (c == a || c == b || d == a || d == b) return false;
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

bool crosses(const Polygon& loop, const PlanePoint& a, const PlanePoint& b) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (crosses(a, b, loop[k], loop[(k + 1) % loop.size()])) return true;
  return false;
}

struct Bridge {
  double length;
  std::size_t from, loop, to;  // a corner of the polygon so far, and one of a loop
};

/// The shortest that touches nothing on its way.
Bridge shortest_bridge(const Polygon& so_far, const std::vector<Polygon>& loops) {
  std::vector<Bridge> bridges;  // from each corner of a loop to the nearest one
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    for (std::size_t to = 0; to < loops[loop].size(); ++to) {
      Bridge& shortest = bridges.emplace_back(Bridge{std::numeric_limits<double>::infinity(), 0, loop, to});
      for (std::size_t from = 0; from < so_far.size(); ++from)
        if (const double length = distance(so_far[from], loops[loop][to]); length < shortest.length)
          shortest.length = length, shortest.from = from;
    }
  }
  std::ranges::sort(bridges, {}, &Bridge::length);
  const auto is_free = [&](const Bridge& bridge) {
    const PlanePoint &a = so_far[bridge.from], &b = loops[bridge.loop][bridge.to];
    return !crosses(so_far, a, b) &&
           std::ranges::none_of(loops, [&](const Polygon& loop) { return crosses(loop, a, b); });
  };
  const auto found = std::ranges::find_if(bridges, is_free);
  return found == bridges.end() ? bridges.front() : *found;
}

}  // namespace

std::vector<Polygon> loops_around(const Mesh& mesh, std::string& fault) {
  for (const MeshElement& element : mesh.elements) {
    for (const Node node : element.nodes) {
      const SpacePoint& x = mesh.nodes.at(node);
      if (x[2] == 0) continue;
      fault =
          fmt::format("does not lie in the plane of x and y: a node is at ({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
      return {};
    }
  }
  std::multimap<Node, Node> open = open_sides(mesh, fault);
  std::vector<Polygon> loops;
  while (!open.empty()) {
    Polygon& loop = loops.emplace_back();
    for (auto side = open.begin(); side != open.end();) {
      loop.push_back(in_plane(mesh.nodes.at(side->first)));
      const Node next = side->second;
      open.erase(side);
      side = open.find(next);  // none: back at the first
    }
    loop = without_straight_corners(loop);
  }
  return loops;
}

Polygon joined(std::vector<Polygon> loops) {
  Polygon polygon = std::move(loops.front());
  loops.erase(loops.begin());
  while (!loops.empty()) {
    const Bridge bridge = shortest_bridge(polygon, loops);
    Polygon loop = std::move(loops[bridge.loop]);
    loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(bridge.loop));
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(bridge.to), loop.end());
    loop.push_back(loop.front());
    const auto at = polygon.begin() + static_cast<std::ptrdiff_t>(bridge.from);
    loop.push_back(*at);
    polygon.insert(at + 1, loop.begin(), loop.end());
  }
  return polygon;
}

std::vector<Facet> surface_of(const Mesh& mesh, std::string& fault) {
  std::map<Nodes, std::pair<Nodes, int>> faces;  // by their corners, in the order of their tags
  for (const MeshElement& element : mesh.elements) {
    for (Nodes& face : faces_outwards(mesh, element)) {
      Nodes corners(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(face.size() == 6 ? 3 : face.size()));
      std::ranges::sort(corners);
      auto& [known, count] = faces[corners];
      known = std::move(face);
      if (++count <= 2) continue;
      const SpacePoint& x = mesh.nodes.at(corners[0]);
      fault = fmt::format("elements lie in each other at ({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
      return {};
    }
  }
  std::vector<Facet> facets;
  for (const auto& [corners, face] : faces)
    if (face.second == 1) add_triangles(mesh, face.first, facets);
  return facets;
}

}  // namespace stillpoint

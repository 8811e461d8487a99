// Closed surfaces of triangles, and files of them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/triangle_solid.hpp"

namespace stillpoint::test {

/// |x| + |y| + |z| = 1.
inline std::vector<Facet> octahedron() {
  std::vector<Facet> triangles;
  for (int k = 0; k < 8; ++k) {
    const double a = (k & 1) != 0 ? -1 : 1, b = (k & 2) != 0 ? -1 : 1, c = (k & 4) != 0 ? -1 : 1;
    Facet triangle{SpacePoint{a, 0, 0}, {0, b, 0}, {0, 0, c}};
    if (a * b * c < 0) std::swap(triangle[0], triangle[1]);
    triangles.push_back(triangle);
  }
  return triangles;
}

inline std::vector<Facet> box_of_triangles(const SpacePoint& low, const SpacePoint& high) {
  const auto corner = [&](int k) {
    return SpacePoint{((k & 1) != 0 ? high : low)[0], ((k & 2) != 0 ? high : low)[1], ((k & 4) != 0 ? high : low)[2]};
  };
  std::vector<Facet> triangles;
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    triangles.push_back({corner(a), corner(b), corner(c)});
    triangles.push_back({corner(a), corner(c), corner(d)});
  }
  return triangles;
}

inline std::string ascii_stl(const std::vector<Facet>& triangles) {
  std::string text = "solid body\n";
  for (const Facet& triangle : triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const SpacePoint& x : triangle) text += fmt::format("      vertex {} {} {}\n", x[0], x[1], x[2]);
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid body\n";
}

inline std::string binary_stl(const std::vector<Facet>& triangles) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (const Facet& triangle : triangles) {
    for (int k = 0; k < 3; ++k) append(0.0F);
    for (const SpacePoint& x : triangle)
      for (const double coordinate : x) append(static_cast<float>(coordinate));
    append(std::uint16_t{0});
  }
  return bytes;
}

}  // namespace stillpoint::test

// What a closed surface of triangles encloses.
//
// Written here and not taken from a library: all that is needed is which triangles the line through a position meets,
// and that takes the thirty lines of orientation_about(). CGAL's or VTK's answer would bring exact numbers (GMP, MPFR)
// or a hundred shared libraries, and half a minute of templates to compile, and would still leave the moments of what
// lies in a cell to us.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/solid.hpp"

namespace stillpoint {

using Facet = std::array<SpacePoint, 3>;

/// An edge that a closed surface, wound one way all over, cannot have: no triangle on its other side, or one that runs
/// through it the same way. Corners are the same if their coordinates are.
struct OpenEdge {
  SpacePoint from, to;
};
std::optional<OpenEdge> open_edge(const std::vector<Facet>& triangles);

/// Positive if the triangles' corners run counter-clockwise seen from outside.
double signed_volume(const std::vector<Facet>& triangles);

/// - A position is inside if the line from it along x leaves the surface once more than it enters. In the plane of y
///   and z each edge is met or not by the same comparison from both of its triangles, and corners by half-open
///   intervals: a line through an edge or a corner counts right.
/// - A rule is Gauss's theorem along x in the box, of which a triangle T cuts off
///
///     ∫ q dV = Σ_T ∫∫ over T's projection, with the sign of its normal's x, of ∫ from x_low to x_T(y, z) of q dx,
///
///   x_T no more than x_high: exact but for rounding, by points that need not lie inside and weights of both signs.
class TriangleSolid final : public Solid {
 public:
  /// Closed and wound one way all over; a surface that is wound inside out is turned.
  explicit TriangleSolid(std::vector<Facet> triangles);

  SpaceBox bounds() const override { return bounds_; }
  bool contains(const SpacePoint& x) const override;
  Part part_of(const SpaceBox& box) const override;
  SpaceRule rule(const SpaceBox& box, int degree) const override;
  bool rules_lie_inside() const override { return false; }

  const std::vector<Facet>& triangles() const { return triangles_; }

 private:
  std::array<int, 2> bin_of(double y, double z) const;
  /// Those whose boxes meet this one's column along x, in ascending order.
  std::vector<int> in_column(const SpaceBox& box) const;

  std::vector<Facet> triangles_;
  std::vector<SpaceBox> boxes_;  // of the triangles
  SpaceBox bounds_{};
  int bins_ = 1;  // along y and z
  std::vector<std::vector<int>> bin_;
};

}  // namespace stillpoint

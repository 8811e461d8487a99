// The solid that a closed surface of triangles encloses.
//
// It is written here and not taken from a library: all that is needed are the triangles that the line through a
// position meets, and that takes the thirty lines of orientation_about(). CGAL or VTK would bring exact numbers (GMP,
// MPFR) or a hundred shared libraries, and half a minute of templates to compile, and would still leave the moments of
// the part in a cell to be computed here.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/solid.hpp"

namespace stillpoint {

using Facet = std::array<SpacePoint, 3>;

/// An edge that a closed, consistently wound surface cannot have: one without a triangle on its other side, or with one
/// that runs through it in the same direction. Corners are the same if their coordinates are.
struct OpenEdge {
  SpacePoint from, to;
};
std::optional<OpenEdge> open_edge(const std::vector<Facet>& triangles);

/// The volume, positive if the triangles' corners run counter-clockwise seen from outside.
double signed_volume(const std::vector<Facet>& triangles);

/// - A position is inside if the line from it along x leaves the surface once more than it enters. In the plane of y
///   and z an edge is met or not by the same comparison from both of its triangles, and corners by half-open
///   intervals: a line through an edge or a corner is counted correctly.
/// - A rule is Gauss's theorem along x in the box, of which a triangle T cuts off
///
///     ∫ q dV = Σ_T ∫∫ over T's projection, with the sign of its normal's x, of ∫ from x_low to x_T(y, z) of q dx,
///
///   with x_T ≤ x_high: exact except for rounding, by points that need not lie inside and weights of both signs.
class TriangleSolid final : public Solid {
 public:
  /// triangles: closed and consistently wound; a surface that is wound inside out is turned.
  explicit TriangleSolid(std::vector<Facet> triangles);

  SpaceBox bounds() const override { return bounds_; }
  bool contains(const SpacePoint& x) const override;
  Part part_of(const SpaceBox& box) const override;
  SpaceRule rule(const SpaceBox& box, int degree) const override;
  bool rules_lie_inside() const override { return false; }

  const std::vector<Facet>& triangles() const { return triangles_; }

 private:
  std::array<int, 2> bin_of(double y, double z) const;
  /// The triangles whose boxes meet this box's column along x, in ascending order.
  std::vector<int> in_column(const SpaceBox& box) const;

  std::vector<Facet> triangles_;
  std::vector<SpaceBox> boxes_;  // bounding boxes of the triangles
  SpaceBox bounds_{};
  int bins_ = 1;  // number along y and along z
  std::vector<std::vector<int>> bin_;
};

}  // namespace stillpoint

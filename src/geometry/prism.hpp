// A prism: a polygon extruded along an axis.
#pragma once

#include <array>
#include <cstddef>

#include "geometry/polygon.hpp"
#include "geometry/solid.hpp"

namespace stillpoint {

/// A rule is the product of a rule on the polygon's part in the box and one on an interval: exact except for rounding.
class Prism final : public Solid {
 public:
  /// polygon: corners in the two other coordinates, in the order of the axes.
  Prism(Polygon polygon, std::size_t axis, double from, double to);

  SpaceBox bounds() const override { return bounds_; }
  bool contains(const SpacePoint& x) const override;
  Part part_of(const SpaceBox& box) const override;
  SpaceRule rule(const SpaceBox& box, int degree) const override;

 private:
  Polygon polygon_;
  std::size_t axis_;
  std::array<std::size_t, 2> across_;
  SpaceBox bounds_;
};

/// The coordinates across an axis.
constexpr std::array<std::size_t, 2> across(std::size_t axis) { return {axis == 0 ? 1UL : 0UL, axis == 2 ? 1UL : 2UL}; }

}  // namespace stillpoint

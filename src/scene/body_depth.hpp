// How deep a position inside a body lies below its surface, along an axis.
#pragma once

#include <stillpoint/problem.hpp>

#include <memory>
#include <optional>
#include <span>

#include "geometry/polygon.hpp"
#include "geometry/solid.hpp"

namespace stillpoint {

/// The share of a cell within which a body touches a face of the grid.
constexpr double touching = 1e-6;

class BodyDepth {
 public:
  /// The body outlives it.
  explicit BodyDepth(const BodySpec& body);

  /// True if the surface of the body is known, which it is not if the points are from a file.
  bool is_known() const { return body_.shape() != BodyShape::points; }
  /// From X, inside the body and before the motion, along an axis upwards or downwards to where the body ends [m];
  /// `most` [m] if that is further. Empty if it has no surface that is known.
  std::optional<double> along(std::span<const double> X, std::size_t axis, bool upwards, double most) const;
  /// True if X lies in the body.
  bool contains(std::span<const double> X) const;

 private:
  const BodySpec& body_;
  Polygon outline_;                     // the outline of a polygon in the plane, otherwise empty
  std::shared_ptr<const Solid> solid_;  // the solid of a body in space that is no box, otherwise null
};

}  // namespace stillpoint

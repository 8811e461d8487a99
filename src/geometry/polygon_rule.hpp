// Quadrature over a polygon.
#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace stillpoint {

/// Points and their shares of the area: Σ_q share_q q(x_q) is the mean of q.
struct PlaneRule {
  std::vector<PlanePoint> x;
  std::vector<double> share;  // > 0, sum 1
};

/// A rule for polynomials of this total degree, exact except for rounding; all its points lie inside. The polygon has
/// to have an area; it may be non-convex, in several parts, and joined by borders that are run through both ways, as
/// clipped_to_unit_square leaves them.
///
/// Verticals through all corners cut the polygon into trapezoids, with Gauss-Legendre positions along x, and along y
/// from edge to edge:
///
///   ∫ q dA = Σ_trapezoids ∫ (∫ from y_lower(x) to y_upper(x) of q dy) dx,
///
/// in which the inner integral is a polynomial in x of one degree more.
PlaneRule polygon_rule(const Polygon& polygon, int degree);

}  // namespace stillpoint

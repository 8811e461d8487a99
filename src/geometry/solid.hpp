// A closed set with a volume, in which the points of a body in space are placed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace stillpoint {

using SpacePoint = std::array<double, 3>;

/// A box: an interval along each axis.
struct SpaceBox {
  SpacePoint low, high;

  double volume() const {
    double product = 1;
    for (std::size_t d = 0; d < 3; ++d) product *= std::max(0.0, high[d] - low[d]);
    return product;
  }
  SpacePoint middle() const {
    SpacePoint x;
    for (std::size_t d = 0; d < 3; ++d) x[d] = (low[d] + high[d]) / 2;
    return x;
  }
};

inline SpaceBox in_common(const SpaceBox& a, const SpaceBox& b) {
  SpaceBox both = a;
  for (std::size_t d = 0; d < 3; ++d) {
    both.low[d] = std::max(a.low[d], b.low[d]);
    both.high[d] = std::min(a.high[d], b.high[d]);
  }
  return both;
}

/// A quadrature rule: Σ_q weight_q q(x_q) = ∫ q dV.
struct SpaceRule {
  std::vector<SpacePoint> x;
  std::vector<double> weight;
};

class Solid {
 public:
  enum class Part { none, some, all };

  virtual ~Solid() = default;
  virtual SpaceBox bounds() const = 0;
  /// True if x is inside; for a position on the surface either answer may be given.
  virtual bool contains(const SpacePoint& x) const = 0;
  /// A fast answer on how much of a box is inside: `some` may turn out to be none or all.
  virtual Part part_of(const SpaceBox& box) const = 0;
  /// A quadrature rule over the part in a box, for polynomials of this total degree.
  virtual SpaceRule rule(const SpaceBox& box, int degree) const = 0;
  /// True if all points of a rule lie inside, with weights > 0.
  virtual bool rules_lie_inside() const { return true; }
};

/// The volume of the part in a box [m³].
inline double volume_in(const Solid& solid, const SpaceBox& box) {
  const SpaceRule rule = solid.rule(box, 0);
  return std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0);
}

}  // namespace stillpoint

// Gauss–Legendre quadrature on an interval.
#pragma once

#include <cstddef>
#include <vector>

namespace stillpoint {

/// n positions in [a, b], ascending, and their weights: exact up to degree 2n − 1.
struct GaussRule {
  GaussRule(double a, double b, std::size_t n);
  std::vector<double> at, weight;
};

/// The rule on [0, 1] that is exact up to a degree.
struct UnitRule : GaussRule {
  explicit UnitRule(int degree) : GaussRule(0, 1, static_cast<std::size_t>(degree / 2 + 1)) {}
};

}  // namespace stillpoint

// The straight line through some points by least squares.
#pragma once

#include <stillpoint/types.hpp>

#include <cstddef>
#include <numeric>

namespace stillpoint {

/// The line y ≈ at_zero + slope x.
struct LineFit {
  double at_zero, slope;
  double slope_variance;  // Σ(y − at_zero − slope x)²/((n − 2) Σ(x − x̄)²)
};

/// Fits a line to points x, y: (n), n ≥ 2, not all x the same. Computed from deviations from the means, which keeps the
/// digits of points far from 0.
inline LineFit fit_line(ConstVec x, ConstVec y) {
  const auto n = static_cast<double>(x.size());
  const double middle_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
  const double middle_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xx = 0, xy = 0, squares = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - middle_x) * (x[k] - middle_x);
    xy += (x[k] - middle_x) * (y[k] - middle_y);
  }
  const double slope = xy / xx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = y[k] - middle_y - slope * (x[k] - middle_x);
    squares += off * off;
  }
  return {middle_y - slope * middle_x, slope, squares / ((n - 2) * xx)};
}

}  // namespace stillpoint

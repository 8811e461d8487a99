// The straight line through some points by least squares.
#pragma once

#include <stillpoint/types.hpp>

namespace stillpoint {

/// The line y ≈ at_zero + slope x.
struct LineFit {
  double at_zero, slope;
  double slope_variance;  // Σ(y − at_zero − slope x)²/((n − 2) Σ(x − x̄)²)
};

/// Fits a line to points x, y: (n), n ≥ 2, not all x the same.
LineFit fit_line(ConstVec x, ConstVec y);

}  // namespace stillpoint

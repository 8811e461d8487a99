// The spectral radius of a real 2 × 2 matrix, which tells a stable map from an unstable one.
#pragma once

#include <cmath>

namespace stillpoint {

struct TwoByTwo {
  double trace = 0, determinant = 0;
};

/// The largest |λ| over the roots of λ² − trace λ + determinant = 0.
inline double spectral_radius(const TwoByTwo& matrix) {
  const double half = matrix.trace / 2, discriminant = half * half - matrix.determinant;
  return discriminant < 0 ? std::sqrt(matrix.determinant) : std::abs(half) + std::sqrt(discriminant);
}

}  // namespace stillpoint

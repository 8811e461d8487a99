// sinh x/cosh c and cosh x/cosh c for |x| ≤ c, also if cosh c itself overflows: terms of Fourier series across a
// rectangle.
#pragma once

#include <cmath>

namespace stillpoint {

struct HyperbolicRatios {
  double sinh, cosh;
};

inline HyperbolicRatios over_cosh(double x, double c) {
  const double decay = std::exp(std::abs(x) - c) / (1 + std::exp(-2 * c)), other = std::exp(-2 * std::abs(x));
  return {std::copysign(decay * (1 - other), x), decay * (1 + other)};
}

}  // namespace stillpoint

// Critical damping of leapfrog itself, for a narrow spectrum. A step h takes ω² of M⁻¹K to 1 − h²ω²/2 = cos θ, a
// motion of the angle θ a step; the usual large step damps the highest modes less than the lowest. With
//
//   h² = 4/(ω₁² + ω_max²),   c = 2 ω₁ √(1 − h²ω₁²/4)
//
// both ends are critical, and all modes go by (√κ − 1)/(√κ + 1) a step, as by Polyak's heavy ball [1964]; for a large κ
// that c is 2 ω₁.
#pragma once

#include <algorithm>
#include <cmath>

namespace stillpoint {

inline double balanced_step(double omega_1, double omega_max) { return 2 / std::hypot(omega_1, omega_max); }
inline double balanced_damping(double omega_1, double h) {
  return 2 * omega_1 * std::sqrt(std::max(0.0, 1 - h * h * omega_1 * omega_1 / 4));
}

}  // namespace stillpoint

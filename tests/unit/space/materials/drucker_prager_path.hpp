// A material point of Drucker–Prager soil on a path of strain, and the invariants of its stress.
#pragma once

#include <stillpoint/drucker_prager.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace stillpoint::test {

using enum StressState;

constexpr double degree = std::numbers::pi / 180;
constexpr double E = 1e7, nu = 0.2, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));

// A material point on its way: each step is a trial from the committed history, then committed.
template <StressState S>
struct Path {
  DruckerPrager<S> law;
  typename DruckerPrager<S>::History now{};
  Gradient<S> H{};

  explicit Path(const DruckerPragerParameters& m, const Stress<S>& stress = {}) : law(m) {
    now = law.initial_history(stress);
  }
  Gradient<S> step(const Gradient<S>& to, double dt = 0) {
    Gradient<S> dH;
    for (std::size_t a = 0; a < H.size(); ++a) dH[a] = to[a] - H[a];
    H = to;
    return law.first_piola(H, dH, dt, now);
  }
  // Straight to H in equal increments.
  void go(const Gradient<S>& to, int steps, double dt = 0) {
    const Gradient<S> from = H;
    for (int k = 1; k <= steps; ++k) {
      Gradient<S> next;
      for (std::size_t a = 0; a < H.size(); ++a) next[a] = from[a] + (to[a] - from[a]) * k / steps;
      step(next, dt);
    }
  }
  double gap() const { return now[4]; }
  double plastic_strain() const { return now[5]; }
};

inline double pressure(const Stress<plane_strain>& s) { return (s[0] + s[1] + s[2]) / 3; }  // p, tension positive
inline double root_J2(const Stress<plane_strain>& s) {
  const double p = pressure(s), x = s[0] - p, y = s[1] - p, z = s[2] - p;
  return std::sqrt((x * x + y * y + z * z) / 2 + s[3] * s[3]);
}
template <StressState S>
double p_of(const Path<S>& path) {
  return pressure(path.law.cauchy(path.now));
}
template <StressState S>
double root_J2_of(const Path<S>& path) {
  return root_J2(path.law.cauchy(path.now));
}

}  // namespace stillpoint::test

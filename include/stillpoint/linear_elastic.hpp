// Linear elasticity at small strain: σ = λ tr(ε) I + 2 μ ε, P = σ.
#pragma once

#include <stillpoint/material.hpp>

namespace stillpoint {

template <StressState S>
class LinearElastic {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = false;

  explicit LinearElastic(const LameParameters& m) : lambda_(m.lambda), mu_(m.mu) {
    if (S == StressState::uniaxial_stress)
      young_ = m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu);
    else
      young_ = m.lambda + 2 * m.mu;
  }

  Gradient<S> first_piola(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      return {young_ * H[0]};
    } else {
      const double tr = lambda_ * (H[0] + H[3]);
      const double xy = mu_ * (H[1] + H[2]);
      Gradient<S> P{};
      P[0] = tr + 2 * mu_ * H[0];
      P[1] = P[2] = xy;
      P[3] = tr + 2 * mu_ * H[3];
      return P;
    }
  }
  Stress<S> cauchy(const Gradient<S>& H) const {
    const Gradient<S> P = first_piola(H);
    if constexpr (dimensions(S) == 1)
      return {P[0]};
    else
      return {P[0], P[3], lambda_ * (H[0] + H[3]), P[1]};
  }
  Moduli<S> moduli(const Gradient<S>&) const {
    Moduli<S> A{};
    constexpr int n = gradient_components(S);
    for (int b = 0; b < n; ++b) {
      Gradient<S> H{};
      H[b] = 1;
      const Gradient<S> P = first_piola(H);
      for (int a = 0; a < n; ++a) A[n * a + b] = P[a];
    }
    return A;
  }

 private:
  double lambda_, mu_, young_;  // [Pa]
};

}  // namespace stillpoint

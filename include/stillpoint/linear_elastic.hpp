// Linear elasticity at small strain: σ = λ tr(ε) I + 2 μ ε, ε = (H + Hᵀ)/2, P = σ.
#pragma once

#include <stillpoint/tensor.hpp>

namespace stillpoint {

template <StressState S>
class LinearElastic {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = false;

  explicit LinearElastic(const LameParameters& m)
      : uniaxial_(S == StressState::uniaxial_stress ? m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu)  // E
                                                    : m.lambda + 2 * m.mu),
        // σ_zz = 0 for ε_zz = −λ/(λ + 2μ) (ε_xx + ε_yy); what is left of λ is 2 λ μ/(λ + 2μ)
        lambda_(S == StressState::plane_stress ? 2 * m.lambda * m.mu / (m.lambda + 2 * m.mu) : m.lambda),
        mu_(m.mu) {}

  Gradient<S> first_piola(const Gradient<S>& H) const {
    const Stress<S> sigma = cauchy(H);
    if constexpr (dimensions(S) == 1) {
      return sigma;
    } else {
      return gradient_part<S>(stress_tensor<S>(sigma));
    }
  }

  Stress<S> cauchy(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // σ_xx = E ε_xx if the section is free to contract, (λ + 2μ) ε_xx if it is not
      return {uniaxial_ * H[0]};
    } else if constexpr (S == StressState::space) {
      const double all_round = lambda_ * (H[0] + H[4] + H[8]);  // λ tr(ε)
      return {all_round + 2 * mu_ * H[0], all_round + 2 * mu_ * H[4], all_round + 2 * mu_ * H[8],
              mu_ * (H[1] + H[3]),        mu_ * (H[5] + H[7]),        mu_ * (H[2] + H[6])};
    } else {
      const double e_zz = S == StressState::axisymmetric ? H[H.size() - 1] : 0;
      const double all_round = lambda_ * (H[0] + H[3] + e_zz);  // λ tr(ε)
      const double sigma_zz = S == StressState::plane_stress ? 0 : all_round + 2 * mu_ * e_zz;
      return {all_round + 2 * mu_ * H[0], all_round + 2 * mu_ * H[3], sigma_zz, mu_ * (H[1] + H[2])};
    }
  }

  // σ is linear in H: column b is the stress of H_b = 1.
  Moduli<S> moduli(const Gradient<S>&) const {
    constexpr int components = gradient_components(S);
    Moduli<S> A{};
    for (int b = 0; b < components; ++b) {
      Gradient<S> one{};
      one[b] = 1;
      const Gradient<S> P = first_piola(one);
      for (int a = 0; a < components; ++a) A[components * a + b] = P[a];
    }
    return A;
  }

 private:
  double uniaxial_;     // σ/ε in one dimension: E, or λ + 2μ [Pa]
  double lambda_, mu_;  // in two and three dimensions [Pa]
};

}  // namespace stillpoint

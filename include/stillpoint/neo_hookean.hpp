// Compressible neo-Hookean elasticity at finite strain [Bonet and Wood 2008, eqs. 6.27 to 6.29]:
//   W = μ/2 (tr C − 3 − 2 ln J) + λ/2 (ln J)²,   P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ.
#pragma once

#include <stillpoint/material.hpp>

#include <cmath>

namespace stillpoint {

template <StressState S>
class NeoHookean {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = true;

  explicit NeoHookean(const LameParameters& m) : lambda_(m.lambda), mu_(m.mu) {}

  // With the stretch F = 1 + H and the section's area ratio w (1 where it cannot contract), J = F w:
  //   P = μ (F − 1/F) + λ ln J / F     (NaN where F ≤ 0: not admissible)
  Gradient<S> first_piola(const Gradient<S>& H) const {
    const double F = 1 + H[0], log_J = std::log(F) + log_area_ratio(F);
    return {mu_ * (F - 1 / F) + lambda_ * log_J / F};
  }
  // σ = P/w: the force on the section that there is now
  Stress<S> cauchy(const Gradient<S>& H) const { return {first_piola(H)[0] * std::exp(-log_area_ratio(1 + H[0]))}; }
  // dP/dF = μ (1 + 1/F²) + λ (1 − ln J + F w'/w)/F²
  Moduli<S> moduli(const Gradient<S>& H) const {
    const double F = 1 + H[0], s = log_area_ratio(F);
    // g(s) = 0 below gives ds/dF = −(λ/F)/(μ w + λ)
    const double ds_dF = S == StressState::uniaxial_stress ? -lambda_ / F / (mu_ * std::exp(s) + lambda_) : 0;
    return {mu_ * (1 + 1 / (F * F)) + lambda_ * (1 + F * ds_dF - std::log(F) - s) / (F * F)};
  }

 private:
  // s = ln w from the free side, μ (w − 1) + λ ln(F w) = 0:  g(s) = μ (eˢ − 1) + λ (ln F + s) = 0.
  // g is convex and increasing, so Newton's method from s = 0 converges from any F > 0.
  double log_area_ratio(double F) const {
    if constexpr (S == StressState::uniaxial_strain) return 0;
    const double log_F = std::log(F);
    double s = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const double w = std::exp(s);
      const double change = (mu_ * (w - 1) + lambda_ * (log_F + s)) / (mu_ * w + lambda_);
      s -= change;
      if (!(std::abs(change) > 1e-16 * (1 + std::abs(s)))) break;  // also leaves on NaN
    }
    return s;
  }

  double lambda_, mu_;  // [Pa]
};

}  // namespace stillpoint

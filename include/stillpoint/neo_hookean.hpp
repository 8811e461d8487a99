// Compressible neo-Hookean elasticity at finite strain [Bonet and Wood 2008, eqs. 6.27 to 6.29]:
//   W = μ/2 (tr C − 3 − 2 ln J) + λ/2 (ln J)²,   P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ,   τ = μ (b − I) + λ ln J I, b = F Fᵀ.
#pragma once

#include <stillpoint/logarithm.hpp>
#include <stillpoint/tensor.hpp>

#include <cmath>

namespace stillpoint {

template <StressState S>
class NeoHookean {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = true;

  explicit NeoHookean(const LameParameters& m) : lambda_(m.lambda), mu_(m.mu) {}

  Gradient<S> first_piola(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // With the stretch F = 1 + H and the section's area ratio w (1 if it cannot contract), J = F w:
      //   P = μ (F − 1/F) + λ ln J / F     (NaN if F ≤ 0: not admissible)
      const double F = 1 + H[0], log_J = std::log(F) + log_area_ratio(F);
      return {mu_ * (F - 1 / F) + lambda_ * log_J / F};
    } else {
      const Tensor F = stretched(H);
      return gradient_part<S>(mu_ * F + (lambda_ * log_volume_ratio(F) - mu_) * transpose(inverse(F)));
    }
  }

  Stress<S> cauchy(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // σ = P/w: the force on the section that there is now
      return {first_piola(H)[0] * std::exp(-log_area_ratio(1 + H[0]))};
    } else {
      const Tensor F = stretched(H);  // σ = τ/J
      return stress_part<S>(1 / determinant(F) * kirchhoff(F));
    }
  }

  Moduli<S> moduli(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // dP/dF = μ (1 + 1/F²) + λ (1 − ln J + F w'/w)/F²
      const double F = 1 + H[0], s = log_area_ratio(F);
      // g(s) = 0 below gives ds/dF = −(λ/F)/(μ w + λ)
      const double ds_dF = S == StressState::uniaxial_stress ? -lambda_ / F / (mu_ * std::exp(s) + lambda_) : 0;
      return {mu_ * (1 + 1 / (F * F)) + lambda_ * (1 + F * ds_dF - std::log(F) - s) / (F * F)};
    } else {
      const Tensor F = stretched(H), b = F * transpose(F);
      // δτ = μ (l b + b lᵀ) + λ tr(l) I
      return moduli_of_rate<S>(F, kirchhoff(F), [&](Tensor l) {
        // τ_zz stays 0:  2 μ b_zz l_zz + λ tr(l) = 0
        if constexpr (S == StressState::plane_stress) l.zz = -lambda_ * (l.xx + l.yy) / (2 * mu_ * b.zz + lambda_);
        return mu_ * (l * b + b * transpose(l)) + lambda_ * trace(l) * unit;
      });
    }
  }

 private:
  using Tensor = TensorFor<S>;
  static constexpr Tensor unit = identity<Tensor>;

  // ln J = ln det₂F + ln F_zz, NaN if either is turned inside out
  static double log_volume_ratio(const Tensor& F) {
    if constexpr (S == StressState::space) {
      return logarithm(determinant(F));
    } else {
      return logarithm(plane_determinant(F)) + (S == StressState::plane_strain ? 0 : logarithm(F.zz));
    }
  }
  Tensor kirchhoff(const Tensor& F) const {
    return mu_ * (F * transpose(F) - unit) + lambda_ * log_volume_ratio(F) * unit;
  }

  // F = I + H, in plane stress with the thickness that leaves the faces free, τ_zz = μ (F_zz² − 1) + λ ln(det₂F F_zz) =
  // 0.
  Tensor stretched(const Gradient<S>& H) const {
    Tensor F = deformation_gradient<S>(H);
    if constexpr (S == StressState::plane_stress) {
      F.zz = std::exp(free_log(lambda_ / 2, 2 * std::log(plane_determinant(F))) / 2);  // s = ln F_zz²
    }
    return F;
  }

  // s = ln w from the free side, μ (w − 1) + λ ln(F w) = 0.
  double log_area_ratio(double F) const {
    if constexpr (S == StressState::uniaxial_strain) return 0;
    return free_log(lambda_, std::log(F));
  }

  // The root of g(s) = μ (eˢ − 1) + λ (ln F + s).
  // g is convex and increasing, so Newton's method from s = 0 converges from any F > 0.
  double free_log(double lambda, double log_F) const {
    double s = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const double w = std::exp(s);
      const double change = (mu_ * (w - 1) + lambda * (log_F + s)) / (mu_ * w + lambda);
      s -= change;
      if (!(std::abs(change) > 1e-16 * (1 + std::abs(s)))) break;  // also leaves on NaN
    }
    return s;
  }

  double lambda_, mu_;  // [Pa]
};

}  // namespace stillpoint

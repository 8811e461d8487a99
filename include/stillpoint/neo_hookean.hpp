// Compressible neo-Hookean elasticity at finite strain [Bonet and Wood 2008, eqs. 6.27 to 6.29]:
//   W = μ/2 (tr C − 3 − 2 ln J) + λ/2 (ln J)²,   P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ,   τ = μ (b − I) + λ ln J I, b = F Fᵀ.
// F − F⁻ᵀ, b − I and ln J are taken from H = F − I, so that a strain far below the rounding of 1 keeps its digits.
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
      const double F = 1 + H[0], log_F = std::log1p(H[0]), log_J = log_F + log_area_ratio(log_F);
      return {mu_ * (H[0] * (2 + H[0])) / F + lambda_ * log_J / F};
    } else if constexpr (S == StressState::space) {
      // With j = J − 1, cof F = (1 + tr H) I − Hᵀ + cof H and J F − cof F = (j − tr H) I + J H + Hᵀ − cof H
      const Tensor G = displacement_gradient<S>(H), cof_G = cofactor(G), E = transpose(G) - cof_G;
      const double j = change_of_volume(G, cof_G), J = 1 + j, over_J = 1 / J, tr = trace(G);
      const double mu_over_J = mu_ * over_J, log_over_J = lambda_ * logarithm(J, j) * over_J;
      const double all_round = mu_over_J * (j - tr) + log_over_J * (1 + tr);
      Tensor P = mu_ * G + (mu_over_J - log_over_J) * E;
      P.xx += all_round, P.yy += all_round, P.zz += all_round;
      return gradient_part<S>(P);
    } else {
      // In the plane F − F⁻ᵀ = [[(H_xx − H_yy + j F_xx)/J, H_xy + H_yx/J], …] with J = 1 + j = det₂F
      const Tensor G = stretched(H);
      const double j = change_of_area(G), J = 1 + j, over_J = 1 / J;
      const double log = lambda_ * log_volume_ratio(G), mu_over_J = mu_ * over_J, log_over_J = log * over_J;
      const double crossed = mu_over_J - log_over_J;
      const double all_round = mu_over_J * j + log_over_J;
      return gradient_part<S>({mu_ * G.xx + all_round - crossed * G.yy, mu_ * G.xy + crossed * G.yx,
                               mu_ * G.yx + crossed * G.xy, mu_ * G.yy + all_round - crossed * G.xx,
                               (mu_ * (G.zz * (2 + G.zz)) + log) / (1 + G.zz)});
    }
  }

  Stress<S> cauchy(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // σ = P/w: the force on the section that there is now
      return {first_piola(H)[0] * std::exp(-log_area_ratio(std::log1p(H[0])))};
    } else {
      const Tensor G = stretched(H);  // σ = τ/J
      return stress_part<S>(1 / determinant(unit_plus(G)) * kirchhoff(G));
    }
  }

  Moduli<S> moduli(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // dP/dF = μ (1 + 1/F²) + λ (1 − ln J + F w'/w)/F²
      const double F = 1 + H[0], log_F = std::log1p(H[0]), s = log_area_ratio(log_F);
      // g(s) = 0 below gives ds/dF = −(λ/F)/(μ w + λ)
      const double ds_dF = S == StressState::uniaxial_stress ? -lambda_ / F / (mu_ * std::exp(s) + lambda_) : 0;
      return {mu_ * (1 + 1 / (F * F)) + lambda_ * (1 + F * ds_dF - log_F - s) / (F * F)};
    } else {
      const Tensor G = stretched(H), F = unit_plus(G);
      return moduli_of_rate<S>(F, kirchhoff(G), rate_of_tau(F));
    }
  }

  /// δP under δH, of many points together faster than by their moduli.
  [[gnu::always_inline]] Gradient<S> rate(const Gradient<S>& H, const Gradient<S>& dH) const {
    if constexpr (dimensions(S) == 1) {
      return {moduli(H)[0] * dH[0]};
    } else {
      const Tensor G = stretched(H), F = unit_plus(G);
      return stress_rate<S>(inverse(F), kirchhoff(G), rate_of_tau(F), dH);
    }
  }

 private:
  using Tensor = TensorFor<S>;
  static constexpr Tensor unit = identity<Tensor>;

  // δτ = μ (l b + b lᵀ) + λ tr(l) I
  auto rate_of_tau(const Tensor& F) const {
    return [mu = mu_, lambda = lambda_, b = F * transpose(F)](Tensor l) {
      // τ_zz stays 0:  2 μ b_zz l_zz + λ tr(l) = 0
      if constexpr (S == StressState::plane_stress) l.zz = -lambda * (l.xx + l.yy) / (2 * mu * b.zz + lambda);
      return mu * (l * b + b * transpose(l)) + lambda * trace(l) * unit;
    };
  }

  // ln J = ln det₂F + ln F_zz for F = I + G; NaN if either is turned inside out
  static double log_volume_ratio(const Tensor& G) {
    if constexpr (S == StressState::space) {
      const double j = change_of_volume(G, cofactor(G));
      return logarithm(1 + j, j);
    } else {
      return log_area_ratio(G) + (S == StressState::plane_strain ? 0 : logarithm(1 + G.zz, G.zz));
    }
  }
  static double log_area_ratio(const Tensor& G) requires(S != StressState::space) {
    const double j = change_of_area(G);
    return logarithm(1 + j, j);
  }
  Tensor kirchhoff(const Tensor& G) const { return mu_ * left_strain(G) + lambda_ * log_volume_ratio(G) * unit; }

  // H as a tensor; in plane stress with the thickness that leaves the faces stress-free, τ_zz = μ (F_zz² − 1) + λ
  // ln(det₂F F_zz) = 0.
  Tensor stretched(const Gradient<S>& H) const {
    Tensor G = displacement_gradient<S>(H);
    if constexpr (S == StressState::plane_stress) {
      G.zz = std::expm1(free_log(lambda_ / 2, 2 * log_area_ratio(G)) / 2);  // s = ln F_zz²
    }
    return G;
  }

  // s = ln w for a stress-free side, from μ (w − 1) + λ ln(F w) = 0.
  double log_area_ratio(double log_F) const {
    if constexpr (S == StressState::uniaxial_strain) return 0;
    return free_log(lambda_, log_F);
  }

  // The root of g(s) = μ (eˢ − 1) + λ (ln F + s).
  // g is convex and increasing, so Newton's method from s = 0 converges from any F > 0.
  double free_log(double lambda, double log_F) const {
    double s = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const double w_minus_1 = std::expm1(s);
      const double change = (mu_ * w_minus_1 + lambda * (log_F + s)) / (mu_ * (1 + w_minus_1) + lambda);
      s -= change;
      if (!(std::abs(change) > 1e-16 * (1 + std::abs(s)))) break;  // also leaves on NaN
    }
    return s;
  }

  double lambda_, mu_;  // [Pa]
};

}  // namespace stillpoint

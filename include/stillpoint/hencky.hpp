// Hencky's logarithmic elasticity at finite strain [Hencky 1928; Anand 1979]: Hooke's law between Kirchhoff's stress
// and the logarithmic strain,
//   W = μ tr(e²) + λ/2 (tr e)²,   e = ½ ln b, b = F Fᵀ,   τ = J σ = 2 μ e + λ tr(e) I,   P = τ F⁻ᵀ.
#pragma once

#include <stillpoint/log_strain.hpp>
#include <stillpoint/tensor.hpp>

#include <cmath>

namespace stillpoint {

template <StressState S>
class Hencky {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = true;

  explicit Hencky(const LameParameters& m)
      : uniaxial_(S == StressState::uniaxial_stress ? m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu)  // E
                                                    : m.lambda + 2 * m.mu),
        // τ_zz = 0 for e_zz = −λ/(λ + 2μ) (e_xx + e_yy); what is left of λ is 2 λ μ/(λ + 2μ)
        lambda_(S == StressState::plane_stress ? 2 * m.lambda * m.mu / (m.lambda + 2 * m.mu) : m.lambda),
        mu_(m.mu),
        contraction_(S == StressState::uniaxial_stress ? m.lambda / (m.lambda + m.mu)
                     : S == StressState::plane_stress  ? m.lambda / (m.lambda + 2 * m.mu)
                                                       : 0) {}

  Gradient<S> first_piola(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      return {uniaxial_ * logarithm(1 + H[0], H[0]) / (1 + H[0])};
    } else {
      const Tensor F = deformation_gradient<S>(H);
      return gradient_part<S>(kirchhoff(log_strain(H)) * transpose(inverse(F)));
    }
  }

  /// Whether the strain at H is so small that its logarithm takes no root of a matrix. What first_piola() and rate()
  /// give, first_piola_of_small() and rate_of_small() then give as well, to rounding, and faster.
  bool is_small(const Gradient<S>& H) const requires(S == StressState::space) {
    return is_near_zero(left_strain(displacement_gradient<S>(H)));
  }
  Gradient<S> first_piola_of_small(const Gradient<S>& H) const requires(S == StressState::space) {
    const LogStrain ln = log_strain(H);
    return gradient_part<S>(stress(ln.small_strain(), ln.J) * transpose(inverse(deformation_gradient<S>(H))));
  }

  // σ = τ/J; a free side or face has contracted by J = e^(tr e)
  Stress<S> cauchy(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      const double e = logarithm(1 + H[0], H[0]);
      return {uniaxial_ * e * std::exp((contraction_ - 1) * e)};
    } else {
      const LogStrain ln = log_strain(H);
      return stress_part<S>(std::exp((contraction_ - 1) * ln.J) * kirchhoff(ln));
    }
  }

  Moduli<S> moduli(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // d(E ln F/F)/dF = E (1 − ln F)/F²
      const double F = 1 + H[0];
      return {uniaxial_ * (1 - logarithm(F, H[0])) / (F * F)};
    } else {
      const Tensor F = deformation_gradient<S>(H);
      const LogStrain ln = log_strain(H);
      // δτ = 2 μ δe + λ tr(δe) I
      const auto rate = ln.rate();
      return moduli_of_rate<S>(F, stress(ln.strain_of_one(), ln.J),
                               [&](const Tensor& l) { return stress(rate(l), trace(l)); });
    }
  }

  /// δP under δH, of many points together faster than by their moduli.
  [[gnu::always_inline]] Gradient<S> rate(const Gradient<S>& H, const Gradient<S>& dH) const {
    if constexpr (dimensions(S) == 1) {
      return {moduli(H)[0] * dH[0]};
    } else {
      return rate_of(
          H, dH,
          [](const LogStrain& ln, const Tensor& l) __attribute__((always_inline)) { return ln.strain_and_rate(l); });
    }
  }
  [[gnu::always_inline]] Gradient<S> rate_of_small(const Gradient<S>& H, const Gradient<S>& dH) const
      requires(S == StressState::space) {
    return rate_of(
        H, dH, [](const LogStrain& ln, const Tensor& l) __attribute__((always_inline)) {
          return ln.small_strain_and_rate(l);
        });
  }

 private:
  using Tensor = TensorFor<S>;
  using LogStrain = LogStrainOf<S>;

  static LogStrain log_strain(const Gradient<S>& H) { return LogStrain(displacement_gradient<S>(H)); }

  template <class StrainAndRateAt>
  [[gnu::always_inline]] Gradient<S> rate_of(const Gradient<S>& H, const Gradient<S>& dH,
                                             const StrainAndRateAt& strain_and_rate) const {
    const Tensor F_inverse = inverse(deformation_gradient<S>(H)), l = displacement_gradient<S>(dH) * F_inverse;
    const LogStrain ln = log_strain(H);
    const auto e = strain_and_rate(ln, l);
    return gradient_part<S>((stress(e.rate, trace(l)) - stress(e.strain, ln.J) * transpose(l)) * transpose(F_inverse));
  }

  // 2 μ e + λ tr(e) I, without the stress across a free face
  Tensor stress(const Tensor& e, double trace_e) const {
    Tensor tau = 2 * mu_ * e + lambda_ * trace_e * identity<Tensor>;
    if constexpr (S == StressState::plane_stress) tau.zz = 0;
    return tau;
  }
  Tensor kirchhoff(const LogStrain& ln) const { return stress(ln.strain(), ln.J); }

  double uniaxial_;     // τ/e in one dimension: E, or λ + 2μ [Pa]
  double lambda_, mu_;  // in two and three dimensions [Pa]
  double contraction_;  // −e of the free side (both sides of a bar) per tr(e) of the others
};

}  // namespace stillpoint

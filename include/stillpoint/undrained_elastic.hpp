// Saturated ground from which no water flows, with a law without history for the effective stress σ': as in
// undrained.hpp, but the pore pressure follows from the deformation, and begins at 0:
//
//   σ = σ' − p_w I,   p_w = −(K_w/n) ln J,   or −(K_w/n) tr ε at small strain.
//
// It is elastic in turn: of Hooke's law with λ, that with λ + K_w/n.
#pragma once

#include <stillpoint/logarithm.hpp>
#include <stillpoint/tensor.hpp>

#include <array>
#include <cmath>

namespace stillpoint {

/// Whether the displacement gradient of a state has all of the change of volume: no side is free to contract.
constexpr bool knows_volume(StressState state) {
  return state != StressState::uniaxial_stress && state != StressState::plane_stress;
}

template <ElasticLaw Law>
requires(knows_volume(Law::state)) class UndrainedElastic {
 public:
  static constexpr StressState state = Law::state;
  static constexpr bool finite_strain = Law::finite_strain;

 private:
  static constexpr StressState S = state;
  static constexpr int components = gradient_components(S);
  static constexpr bool has_rate = requires(const Law& law, const Gradient<S>& H) { law.rate(H, H); };
  static constexpr bool eases_small_strain = requires(const Law& law, const Gradient<S>& H) { law.is_small(H); };

 public:
  /// stiffness: K_w/n [Pa].
  UndrainedElastic(const Law& law, double stiffness) : law_(law), stiffness_(stiffness) {}

  [[gnu::always_inline]] Gradient<S> first_piola(const Gradient<S>& H) const {
    return sum(law_.first_piola(H), of_water(H));
  }
  /// The total stress.
  Stress<S> cauchy(const Gradient<S>& H) const {
    Stress<S> sigma = law_.cauchy(H);
    for (std::size_t a = 0; a < (dimensions(S) == 1 ? 1 : 3); ++a) sigma[a] -= pore_pressure(H);
    return sigma;
  }
  double pore_pressure(const Gradient<S>& H) const { return -stiffness_ * growth(H); }

  Moduli<S> moduli(const Gradient<S>& H) const {
    Moduli<S> A = law_.moduli(H);
    for (int b = 0; b < components; ++b) {
      Gradient<S> one{};
      one[b] = 1;
      const Gradient<S> dP = rate_of_water(H, one);
      for (int a = 0; a < components; ++a) A[components * a + b] += dP[a];
    }
    return A;
  }
  [[gnu::always_inline]] Gradient<S> rate(const Gradient<S>& H, const Gradient<S>& dH) const requires has_rate {
    return sum(law_.rate(H, dH), rate_of_water(H, dH));
  }

  // What a law has for small strains.
  bool is_small(const Gradient<S>& H) const requires eases_small_strain { return law_.is_small(H); }
  Gradient<S> first_piola_of_small(const Gradient<S>& H) const requires eases_small_strain {
    return sum(law_.first_piola_of_small(H), of_water(H));
  }
  [[gnu::always_inline]] Gradient<S> rate_of_small(const Gradient<S>& H,
                                                   const Gradient<S>& dH) const requires eases_small_strain {
    return sum(law_.rate_of_small(H, dH), rate_of_water(H, dH));
  }

 private:
  [[gnu::always_inline]] static Gradient<S> sum(const Gradient<S>& P, const Gradient<S>& Q) {
    Gradient<S> both;
    for (std::size_t c = 0; c < both.size(); ++c) both[c] = P[c] + Q[c];
    return both;
  }
  // ln J, or tr ε at small strain, with the digits of a small H.
  [[gnu::always_inline]] static double growth(const Gradient<S>& H) {
    if constexpr (dimensions(S) == 1) {
      return finite_strain ? logarithm(1 + H[0], H[0]) : H[0];
    } else {
      const auto G = displacement_gradient<S>(H);
      if constexpr (!finite_strain) return trace(G);
      const double j = change_of_volume(G);
      return logarithm(1 + j, j);
    }
  }
  // P_w = J (K_w/n) ln J F⁻ᵀ
  [[gnu::always_inline]] Gradient<S> of_water(const Gradient<S>& H) const {
    const double pull = stiffness_ * growth(H);
    if constexpr (dimensions(S) == 1) {
      return {pull};
    } else if constexpr (!finite_strain) {
      return gradient_part<S>(pull * identity<TensorFor<S>>);
    } else {
      const auto F = deformation_gradient<S>(H);
      return gradient_part<S>((pull * determinant(F)) * transpose(inverse(F)));
    }
  }
  // δτ_w = J (K_w/n) (1 + ln J) tr l I
  [[gnu::always_inline]] Gradient<S> rate_of_water(const Gradient<S>& H, const Gradient<S>& dH) const {
    if constexpr (!finite_strain) {
      return of_water(dH);
    } else if constexpr (dimensions(S) == 1) {
      return {stiffness_ * dH[0] / (1 + H[0])};
    } else {
      using Tensor = TensorFor<S>;
      const Tensor F = deformation_gradient<S>(H);
      const double ln_J = growth(H), of_J = stiffness_ * determinant(F);
      return stress_rate<S>(
          inverse(F), (of_J * ln_J) * identity<Tensor>,
          [&](const Tensor& l)
              __attribute__((always_inline)) { return (of_J * (1 + ln_J) * trace(l)) * identity<Tensor>; },
          dH);
    }
  }

  Law law_;
  double stiffness_;
};

}  // namespace stillpoint

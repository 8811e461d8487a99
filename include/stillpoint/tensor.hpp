// The tensors that laws of two and three dimensions use, and the components of them that a stress state stores.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/plane_tensor.hpp>
#include <stillpoint/space_tensor.hpp>

#include <type_traits>

namespace stillpoint {

/// The tensor type of a state's H, P and σ, in two dimensions or three.
template <StressState S>
using TensorFor = std::conditional_t<S == StressState::space, SpaceTensor, PlaneTensor>;

template <class Tensor>
inline constexpr Tensor identity{};
template <>
inline constexpr PlaneTensor identity<PlaneTensor>{1, 0, 0, 1, 1};
template <>
inline constexpr SpaceTensor identity<SpaceTensor>{1, 0, 0, 0, 1, 0, 0, 0, 1};

/// H as a tensor; H_zz = 0 if H has no such component.
template <StressState S>
constexpr TensorFor<S> displacement_gradient(const Gradient<S>& H) {
  if constexpr (S == StressState::space) {
    return {H[0], H[1], H[2], H[3], H[4], H[5], H[6], H[7], H[8]};
  } else if constexpr (S == StressState::axisymmetric) {
    return {H[0], H[1], H[2], H[3], H[4]};
  } else {
    return {H[0], H[1], H[2], H[3], 0};
  }
}
/// F = I + H.
template <StressState S>
constexpr TensorFor<S> deformation_gradient(const Gradient<S>& H) {
  return unit_plus(displacement_gradient<S>(H));
}
/// B = b − I = H + Hᵀ + H Hᵀ, b = F Fᵀ, with the digits of a small H, which b itself loses beside 1.
template <class Tensor>
constexpr Tensor left_strain(const Tensor& H) {
  return H + transpose(H) + H * transpose(H);
}

template <StressState S>
constexpr Gradient<S> gradient_part(const TensorFor<S>& A) {
  if constexpr (S == StressState::space) {
    return {A.xx, A.xy, A.xz, A.yx, A.yy, A.yz, A.zx, A.zy, A.zz};
  } else if constexpr (S == StressState::axisymmetric) {
    return {A.xx, A.xy, A.yx, A.yy, A.zz};
  } else {
    return {A.xx, A.xy, A.yx, A.yy};
  }
}
template <StressState S>
constexpr Stress<S> stress_part(const TensorFor<S>& sigma) {
  if constexpr (S == StressState::space) {
    return {sigma.xx, sigma.yy, sigma.zz, sigma.xy, sigma.yz, sigma.zx};
  } else {
    return {sigma.xx, sigma.yy, sigma.zz, sigma.xy};
  }
}
template <StressState S>
constexpr TensorFor<S> stress_tensor(const Stress<S>& s) {
  if constexpr (S == StressState::space) {
    return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
  } else {
    return {s[0], s[3], s[3], s[1], s[2]};
  }
}

/// δP for δH from the rate of the Kirchhoff stress, rate(l) = δτ for l = δF F⁻¹:  P = τ F⁻ᵀ,  δP = (δτ − τ lᵀ) F⁻ᵀ.
template <StressState S, class Rate>
constexpr Gradient<S> stress_rate(const TensorFor<S>& F_inverse, const TensorFor<S>& tau, const Rate& rate,
                                  const Gradient<S>& dH) {
  const TensorFor<S> l = displacement_gradient<S>(dH) * F_inverse;
  return gradient_part<S>((rate(l) - tau * transpose(l)) * transpose(F_inverse));
}

/// The moduli ∂P/∂H from that rate, column by column.
template <StressState S, class Rate>
constexpr Moduli<S> moduli_of_rate(const TensorFor<S>& F, const TensorFor<S>& tau, const Rate& rate) {
  constexpr int components = gradient_components(S);
  const TensorFor<S> F_inverse = inverse(F);
  Moduli<S> A{};
  for (int b = 0; b < components; ++b) {
    Gradient<S> one{};
    one[b] = 1;
    const Gradient<S> dP = stress_rate<S>(F_inverse, tau, rate, one);
    for (int a = 0; a < components; ++a) A[components * a + b] = dP[a];
  }
  return A;
}

}  // namespace stillpoint

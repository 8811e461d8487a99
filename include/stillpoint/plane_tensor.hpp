// Tensors of plane and axisymmetric problems: the third direction (z, or the hoop θ) is a principal one.
#pragma once

#include <stillpoint/material.hpp>

namespace stillpoint {

struct PlaneTensor {
  double xx, xy, yx, yy, zz;
};

inline constexpr PlaneTensor identity{1, 0, 0, 1, 1};

constexpr PlaneTensor operator+(const PlaneTensor& A, const PlaneTensor& B) {
  return {A.xx + B.xx, A.xy + B.xy, A.yx + B.yx, A.yy + B.yy, A.zz + B.zz};
}
constexpr PlaneTensor operator-(const PlaneTensor& A, const PlaneTensor& B) {
  return {A.xx - B.xx, A.xy - B.xy, A.yx - B.yx, A.yy - B.yy, A.zz - B.zz};
}
constexpr PlaneTensor operator*(double a, const PlaneTensor& A) {
  return {a * A.xx, a * A.xy, a * A.yx, a * A.yy, a * A.zz};
}
constexpr PlaneTensor operator*(const PlaneTensor& A, const PlaneTensor& B) {
  return {A.xx * B.xx + A.xy * B.yx, A.xx * B.xy + A.xy * B.yy, A.yx * B.xx + A.yy * B.yx, A.yx * B.xy + A.yy * B.yy,
          A.zz * B.zz};
}
constexpr PlaneTensor transpose(const PlaneTensor& A) { return {A.xx, A.yx, A.xy, A.yy, A.zz}; }
constexpr double trace(const PlaneTensor& A) { return A.xx + A.yy + A.zz; }
/// Of the part in the plane, det₂ A.
constexpr double plane_determinant(const PlaneTensor& A) { return A.xx * A.yy - A.xy * A.yx; }
constexpr double determinant(const PlaneTensor& A) { return plane_determinant(A) * A.zz; }
constexpr PlaneTensor inverse(const PlaneTensor& A) {
  const double r = 1 / plane_determinant(A);
  return {r * A.yy, -r * A.xy, -r * A.yx, r * A.xx, 1 / A.zz};
}

/// F = I + H; F_zz = 1 if H does not know it.
template <StressState S>
constexpr PlaneTensor deformation_gradient(const Gradient<S>& H) {
  if constexpr (S == StressState::axisymmetric) {
    return {1 + H[0], H[1], H[2], 1 + H[3], 1 + H[4]};
  } else {
    return {1 + H[0], H[1], H[2], 1 + H[3], 1};
  }
}

template <StressState S>
constexpr Gradient<S> gradient_part(const PlaneTensor& A) {
  if constexpr (S == StressState::axisymmetric) {
    return {A.xx, A.xy, A.yx, A.yy, A.zz};
  } else {
    return {A.xx, A.xy, A.yx, A.yy};
  }
}
template <StressState S>
constexpr Stress<S> stress_part(const PlaneTensor& sigma) {
  return {sigma.xx, sigma.yy, sigma.zz, sigma.xy};
}

/// δP for δH from the rate of the Kirchhoff stress, rate(l) = δτ for l = δF F⁻¹:  P = τ F⁻ᵀ,  δP = (δτ − τ lᵀ) F⁻ᵀ.
template <StressState S, class Rate>
constexpr Gradient<S> stress_rate(const PlaneTensor& F_inverse, const PlaneTensor& tau, const Rate& rate,
                                  const Gradient<S>& dH) {
  const PlaneTensor dF = deformation_gradient<S>(dH) - deformation_gradient<S>({}), l = dF * F_inverse;
  return gradient_part<S>((rate(l) - tau * transpose(l)) * transpose(F_inverse));
}

/// ∂P/∂H, column by column.
template <StressState S, class Rate>
constexpr Moduli<S> moduli_of_rate(const PlaneTensor& F, const PlaneTensor& tau, const Rate& rate) {
  constexpr int components = gradient_components(S);
  const PlaneTensor F_inverse = inverse(F);
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

// What every elastic law must satisfy, and the deformations to see it at.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/tensor.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <vector>

#include "largest.hpp"

namespace stillpoint::checks {

constexpr double one_degree = std::numbers::pi / 180;

/// E and ν of what is elastic.
constexpr double young = 210.0, poisson = 0.3;
inline const LameParameters lame = LameParameters::from(young, poisson);

/// Displacement gradients of a state: none, small, equal stretches (equal eigenvalues of F Fᵀ), shear and large ones.
template <StressState S>
std::vector<Gradient<S>> deformations() {
  if constexpr (dimensions(S) == 1) {
    return {{-0.6}, {-0.1}, {0.0}, {0.2}, {1.5}, {4.0}};
  } else if constexpr (S == StressState::space) {
    return {{},
            {1e-4, 2e-4, 3e-4, -1e-4, 3e-4, 2e-4, 1e-4, -2e-4, 1e-4},
            {0.3, 0, 0, 0, 0.3, 0, 0, 0, 0.3},
            {0.3, 0, 0, 0, 0.3, 0, 0, 0, -0.2},
            {0, 0.1, 0, 0, 0, 0.3, 0, 0, -0.2},
            {0, -0.5, 0.2, 0.5, 0, 0.1, -0.2, -0.1, 0.1},
            {1.5, 0.4, 0.2, -0.3, -0.5, -0.3, 0.1, 0.5, 0.8},
            {-0.6, 0.2, -0.1, 0.1, 0.3, 0.2, 0.05, -0.3, -0.5}};
  } else {
    const std::vector<PlaneTensor> all = {
        {0, 0, 0, 0, 0},        {1e-4, 2e-4, -1e-4, 3e-4, 1e-4}, {0.3, 0, 0, 0.3, 0.3},      {0, 0.1, 0, 0, -0.2},
        {0, -0.5, 0.5, 0, 0.1}, {1.5, 0.4, -0.3, -0.5, 0.8},     {-0.6, 0.2, 0.1, 0.3, -0.5}};
    std::vector<Gradient<S>> gradients;
    for (const PlaneTensor& H : all) gradients.push_back(gradient_part<S>(H));
    return gradients;
  }
}

/// ∂P/∂H of P(H) by central differences.
template <StressState S, class FirstPiola>
Moduli<S> differences(const FirstPiola& P, const Gradient<S>& H) {
  constexpr int components = gradient_components(S);
  constexpr double d = 1e-6;
  Moduli<S> A{};
  for (int b = 0; b < components; ++b) {
    Gradient<S> above = H, below = H;
    above[b] += d;
    below[b] -= d;
    const Gradient<S> P_above = P(above), P_below = P(below);
    for (int a = 0; a < components; ++a) A[components * a + b] = (P_above[a] - P_below[a]) / (2 * d);
  }
  return A;
}

template <StressState S>
Gradient<S> minus(Gradient<S> a, const Gradient<S>& b) {
  for (std::size_t c = 0; c < a.size(); ++c) a[c] -= b[c];
  return a;
}

/// max |A − B| over max |B|.
template <class Array>
double relative_distance(const Array& A, const Array& B) {
  const double distance = largest_difference(A, B), size = largest_magnitude(B);
  return size > 0 ? distance / size : distance;
}

/// A rotation by an angle, in space about an axis that is none of the coordinates'.
template <class Tensor = PlaneTensor>
Tensor rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  if constexpr (std::is_same_v<Tensor, PlaneTensor>) {
    return {c, -s, s, c, 1};
  } else {
    const double x = 2.0 / 7, y = -3.0 / 7, z = 6.0 / 7;  // R = I + sin θ A + (1 − cos θ) A², A v = (x, y, z) × v
    const SpaceTensor A{0, -z, y, z, 0, -x, -y, x, 0};
    return identity<SpaceTensor> + s * A + (1 - c) * (A * A);
  }
}
/// Q σ Qᵀ
template <StressState S>
Stress<S> turned(const TensorFor<S>& Q, const Stress<S>& sigma) {
  return stress_part<S>(Q * stress_tensor<S>(sigma) * transpose(Q));
}

}  // namespace stillpoint::checks

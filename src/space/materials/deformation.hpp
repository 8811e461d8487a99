// Operations on tensors in the components of a Kinematics: a 1 × 1, 2 × 2 or 3 × 3 matrix, row by row, and if
// axisymmetric the hoop component after it.
#pragma once

#include <stillpoint/tensor.hpp>

#include <utility>

namespace stillpoint {

template <Kinematics K>
using TensorOf = std::array<double, gradient_components(K)>;

/// The tensor of a Cauchy stress σ_xx or σ_xx, σ_yy, σ_zz, σ_xy (σ_zz the hoop stress) and σ_yz, σ_zx.
template <Kinematics K>
TensorOf<K> tensor_of(const std::array<double, stress_components(K)>& s) {
  if constexpr (K == Kinematics::line)
    return {s[0]};
  else if constexpr (K == Kinematics::plane)
    return {s[0], s[3], s[3], s[1]};
  else if constexpr (K == Kinematics::space)
    return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]};
  else
    return {s[0], s[3], s[3], s[1], s[2]};
}

/// The sum I + H.
template <Kinematics K>
TensorOf<K> plus_identity(TensorOf<K> H) {
  constexpr int dim = dimensions(K);
  for (int i = 0; i < dim; ++i) H[(dim + 1) * i] += 1;
  if constexpr (K == Kinematics::axisymmetric) H[4] += 1;
  return H;
}

/// The product A B.
template <Kinematics K>
TensorOf<K> product(const TensorOf<K>& A, const TensorOf<K>& B) {
  constexpr int dim = dimensions(K);
  TensorOf<K> C{};
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      for (int k = 0; k < dim; ++k) C[dim * i + j] += A[dim * i + k] * B[dim * k + j];
    }
  }
  if constexpr (K == Kinematics::axisymmetric) C[4] = A[4] * B[4];
  return C;
}

/// The transpose Aᵀ.
template <Kinematics K>
TensorOf<K> transposed(TensorOf<K> A) {
  constexpr int dim = dimensions(K);
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < i; ++j) std::swap(A[dim * i + j], A[dim * j + i]);
  }
  return A;
}

inline SpaceTensor in_space(const TensorOf<Kinematics::space>& A) {
  return {A[0], A[1], A[2], A[3], A[4], A[5], A[6], A[7], A[8]};
}

template <Kinematics K>
double determinant(const TensorOf<K>& A) {
  if constexpr (K == Kinematics::line)
    return A[0];
  else if constexpr (K == Kinematics::plane)
    return A[0] * A[3] - A[1] * A[2];
  else if constexpr (K == Kinematics::space)
    return determinant(in_space(A));
  else
    return (A[0] * A[3] - A[1] * A[2]) * A[4];
}

/// The inverse A⁻¹.
template <Kinematics K>
TensorOf<K> inverse(const TensorOf<K>& A) {
  if constexpr (K == Kinematics::line) {
    return {1 / A[0]};
  } else if constexpr (K == Kinematics::space) {
    return gradient_part<StressState::space>(inverse(in_space(A)));
  } else {
    const double in_plane = A[0] * A[3] - A[1] * A[2];
    TensorOf<K> B{A[3] / in_plane, -A[1] / in_plane, -A[2] / in_plane, A[0] / in_plane};
    if constexpr (K == Kinematics::axisymmetric) B[4] = 1 / A[4];
    return B;
  }
}

}  // namespace stillpoint

// Moduli with a stress that is not the law's: with the one that the tangent of an earlier state predicts. A long step
// of Newton's method bends a slender body and stretches it by the square of that; the stress of the stretch, which the
// next step takes back, would stiffen it against all bending.
#pragma once

#include <stillpoint/tensor.hpp>

#include <cstddef>

#include "space/materials/point_material.hpp"

namespace stillpoint {

/// Whether the law's moduli depend on its stress, and both on the deformation alone.
template <Kinematics K>
bool has_stress_ahead(const PointMaterial<K>& law) {
  return law.info().finite_strain && !law.info().history_dependent && !law.info().viscous;
}

/// The second Piola–Kirchhoff stress S = F⁻¹ P of point p under F = I + H. V: volumes of all points.
template <Kinematics K>
TensorOf<K> second_piola(const PointMaterial<K>& law, const TensorOf<K>& H, const double* V, std::size_t p) {
  PointBlock<K> block{};
  block.first = p;
  block.count = 1;
  for (std::size_t c = 0; c < H.size(); ++c) block.H[c][0] = H[c];
  law.stress(block, V, 0, nullptr);
  TensorOf<K> P;
  for (std::size_t c = 0; c < H.size(); ++c) P[c] = block.VP[c][0] / V[p];
  return product<K>(inverse<K>(plus_identity<K>(H)), P);
}

/// S⁺ − S at point p under H, with the stress that the tangent A = ∂P/∂H under H₀ predicts there
///   S⁺ = S₀ + F₀⁻¹ (A₀ : δF − δF S₀),  δF = H − H₀  [Magisano, Leonetti and Garcea 2017, CMAME 313:986-1005, §3].
/// V: volumes of all points. Symmetric.
template <Kinematics K>
TensorOf<K> stress_ahead(const PointMaterial<K>& law, const TensorOf<K>& H, const TensorOf<K>& H_0, const double* V,
                         std::size_t p) {
  constexpr int components = gradient_components(K);
  const TensorOf<K> S_0 = second_piola(law, H_0, V, p), S = second_piola(law, H, V, p);
  const auto A_0 = law.moduli(Tangent::consistent, H_0, {}, 0, p);
  TensorOf<K> dF;
  for (int c = 0; c < components; ++c) dF[c] = H[c] - H_0[c];
  TensorOf<K> F_dS = product<K>(dF, S_0);
  for (int c = 0; c < components; ++c) {
    F_dS[c] = -F_dS[c];
    for (int d = 0; d < components; ++d) F_dS[c] += A_0[components * c + d] * dF[d];
  }
  TensorOf<K> ahead = product<K>(inverse<K>(plus_identity<K>(H_0)), F_dS);
  for (int c = 0; c < components; ++c) ahead[c] += S_0[c] - S[c];
  const TensorOf<K> turned = transposed<K>(ahead);
  for (int c = 0; c < components; ++c) ahead[c] = (ahead[c] + turned[c]) / 2;
  return ahead;
}

/// Adds the stress dS to the moduli ∂(F S)/∂F, which hold it as I ⊗ S.
template <Kinematics K>
void add_stress(const TensorOf<K>& dS, typename PointMaterial<K>::ModuliMatrix& A) {
  constexpr int dim = dimensions(K), components = gradient_components(K);
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      for (int l = 0; l < dim; ++l) A[components * (dim * i + j) + dim * i + l] += dS[dim * j + l];
    }
  }
  if constexpr (K == Kinematics::axisymmetric) A.back() += dS.back();
}

}  // namespace stillpoint

// The tangent stiffness of points whose change of volume is their own.
#pragma once

#include <array>
#include <vector>

#include "space/kernels/cell_assembly.hpp"
#include "space/materials/moduli_of.hpp"
#include "space/materials/stress_ahead.hpp"
#include "space/phase/phase_frame.hpp"

namespace stillpoint {

/// The stiffness K_ai,bk = Σ_p V_p G_a,i,c (∂P_c/∂H_d) G_b,k,d with H_c = Σ_a,i G_a,i,c u_a,i, (n × n). u, du: over the
/// grid's functions, du since the last commit, which was dt ago. from, if it is not null: the stresses of elastic
/// points are those that the tangent at that displacement predicts, by stress_ahead().
template <AxisBasis B, Kinematics K>
SparseMatrix matrix_of_points(const PhaseFrame<B, K>& frame, Tangent kind, double dt, const std::vector<double>& u,
                              const std::vector<double>& du, const std::vector<double>* from = nullptr) {
  constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  constexpr int components = gradient_components(K);
  const PointWeights<B, K>& weights = frame.weights;
  const auto add_point = [&](std::size_t k, std::size_t p, CellMatrix<dim, per_cell>& matrix) {
    const auto H = weights.gradient(u.data(), k, p), dH = weights.gradient(du.data(), k, p);
    const PointMaterial<K>& law = frame.material_of(k);
    auto A = moduli_of(law, kind, H, dH, dt, p);
    if (from && has_stress_ahead(law)) {
      const auto H_from = weights.gradient(from->data(), k, p);
      add_stress<K>(stress_ahead(law, H, H_from, frame.body.points.volume.data(), p), A);
    }
    std::array<TensorOf<K>, dim * per_cell> G{};
    const auto dN = weights.dN(k, p);
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) G[dim * a + i][dim * i + j] = dN[per_cell * j + a];
      }
      if constexpr (K == Kinematics::axisymmetric) G[dim * a][dim * dim] = dN[per_cell * dim + a];
    }
    for (int row = 0; row < dim * per_cell; ++row) {
      TensorOf<K> left{};  // V G A
      for (int c = 0; c < components; ++c) {
        if (G[row][c] == 0) continue;
        for (int d = 0; d < components; ++d) left[d] += frame.body.points.volume[p] * G[row][c] * A[components * c + d];
      }
      for (int column = 0; column < dim * per_cell; ++column) {
        for (int d = 0; d < components; ++d) matrix[row][column] += left[d] * G[column][d];
      }
    }
  };
  return assemble_cells<B, K>(frame.grid, frame.body.points, weights, frame.corner_sum, frame.dofs(), add_point).free;
}

}  // namespace stillpoint

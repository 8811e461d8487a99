// The tangent stiffness of points that share their change of volume.
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "space/kernels/cell_assembly.hpp"
#include "space/kernels/gather_scatter_bilinear.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/materials/moduli_of.hpp"
#include "space/phase/material_point_phase.hpp"
#include "space/phase/matrix_with_means.hpp"

namespace stillpoint {

/// The matrices of a cell with a spline basis for the means: the derivatives of forces at its functions and of shares
/// at its splines by displacements of the former and means of the latter.
template <int Unknowns, int Splines>
struct MixedCellMatrix {
  template <int Rows, int Columns>
  using Matrix = std::array<std::array<double, static_cast<std::size_t>(Columns)>, static_cast<std::size_t>(Rows)>;

  Matrix<Unknowns, Splines> force_of_mean{};
  Matrix<Splines, Unknowns> share_of_u{}, mean_of_u{};
  Matrix<Splines, Splines> share_of_mean{};
};

/// A SplinePass for a unit derivative: takes the given rates of means of the block's points, and returns those of
/// shares.
template <AxisBasis B, Kinematics K>
struct UnitPass : SplinePass<B, K> {
  using Row = typename PointBlock<K>::Row;
  Row* rates_of_mean;
  Row* rates_of_share;

  UnitPass(const SplinePass<B, K>& pass, Row& of_mean, Row& of_share)
      : SplinePass<B, K>(pass), rates_of_mean(&of_mean), rates_of_share(&of_share) {}
  void rates_of_means(const PointBlock<K>&, const Row&, Row& mean) const { mean = *rates_of_mean; }
  void rates_of_shares(const PointBlock<K>&, const Row& y, Row& share) const {
    *rates_of_share = y;
    share.fill(0);
  }
};

// Calls visit() with the block's points, H and dH of cell k gathered, once except for a cell with more points than a
// block.
template <AxisBasis B, Kinematics K>
template <class Visit>
void MaterialPointPhase<B, K>::for_parts_of_cell(std::size_t k, Block& block, const Visit& visit) const {
  const MaterialPoints<Dim>& points = body_.points;
  block.first_cell = k;
  block.last_cell = k + 1;
  for (block.first = points.begin(k); block.first < points.end(k); block.first += block.count) {
    block.count = std::min(Block::size, points.end(k) - block.first);
    GatherScatter<B, K>::template gather<true>(weights_, k, block.first, block.first + block.count, grid_u_.data(),
                                               committed_u_.data(), block.first, block.H, block.dH);
    visit();
  }
}

// Sets block.direction to that of a unit of component i of cell k's local function b.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_unit(std::size_t k, int b, int i, Block& block) const {
  for (auto& row : block.direction) std::fill_n(row.begin(), block.count, 0.0);
  for (std::size_t q = 0; q < block.count; ++q) {
    const auto dN = weights_.dN(k, block.first + q);
    for (int j = 0; j < Dim; ++j) block.direction[Dim * i + j][q] = dN[per_cell * j + b];
    if constexpr (K == Kinematics::axisymmetric)
      if (i == 0) block.direction[Dim * Dim][q] = dN[per_cell * Dim + b];
  }
}

// Calls take(column, forces at the cell's functions) for columns 0 … columns − 1; direct(column) sets the block's
// direction.
template <AxisBasis B, Kinematics K>
template <class Mean, class Direct, class Take>
void MaterialPointPhase<B, K>::answer_columns(Tangent kind, double dt, std::size_t k, Block& block, Mean& mean,
                                              int columns, const Direct& direct, const Take& take) const {
  const auto m = static_cast<std::size_t>(body_.points.material_of_cell(k));
  const PointMaterial<K>& law = *body_.materials[m];
  const double* V = body_.points.volume.data() + block.first;
  mean.average(block, committed_averages_.data() + block.first, nullptr);
  law.stress(block, body_.points.volume.data(), dt, scratch_history(m));
  mean.keep_stress(block);
  std::vector<typename PointMaterial<K>::ModuliMatrix> A(block.count);
  for (std::size_t q = 0; q < block.count; ++q)
    A[q] = moduli_of(law, kind, block.H_at(q), block.dH_at(q), dt, block.first + q);
  for (int column = 0; column < columns; ++column) {
    direct(column);
    mean.average_direction(block);
    // V A : δH̄
    for (std::size_t q = 0; q < block.count; ++q) {
      for (int c = 0; c < components; ++c) {
        double dP = 0;
        for (int e = 0; e < components; ++e) dP += A[q][components * c + e] * block.direction[e][q];
        block.VP[c][q] = V[q] * dP;
      }
    }
    mean.transform_tangent(block);
    std::array<double, static_cast<std::size_t>(Dim * per_cell)> force;
    GatherScatter<B, K>::scatter(weights_, k, block.first, block.first + block.count, block, force.data());
    take(column, force);
  }
}

// Assembled column by column, as the points of a cell are coupled.
template <AxisBasis B, Kinematics K>
SparseMatrix MaterialPointPhase<B, K>::matrix_of_means(Tangent kind, double dt) const {
  if constexpr (Dim > 1) {
    if (means_over_splines()) return matrix_of_spline_means(kind, dt);
    Block block;
    const auto add_cell = [&](std::size_t k, CellMatrix<Dim, per_cell>& matrix) {
      for_parts_of_cell(k, block, [&] {
        const auto m = static_cast<std::size_t>(body_.points.material_of_cell(k));
        MeanOverCells<K> mean({body_.points, volume_share_.data() + block.first},
                              body_.materials[m]->info().finite_strain);
        const auto direct = [&](int column) { take_unit(k, column / Dim, column % Dim, block); };
        const auto take = [&](int column, const auto& force) {
          for (int row = 0; row < Dim * per_cell; ++row) matrix[row][column] += force[row];
        };
        answer_columns(kind, dt, k, block, mean, Dim * per_cell, direct, take);
      });
    };
    return assemble_whole_cells<B, K>(grid_, body_.points, weights_, *dofs_, add_cell).free;
  } else {
    throw std::logic_error("there is no mean dilatation in one dimension");
  }
}

// For means over splines, by matrix_with_means().
template <AxisBasis B, Kinematics K>
SparseMatrix MaterialPointPhase<B, K>::matrix_of_spline_means(Tangent kind, double dt) const {
  constexpr int unknowns = Dim * per_cell, splines = SplineMeans<B, K>::per_cell;
  take_means(grid_u_.data());
  take_shares(grid_u_.data(), dt);
  const MaterialPoints<Dim>& points = body_.points;
  const SplinePass<B, K> pass(splines_, points.volume.data(), {.means = &means_, .shares = &shares_});
  MatrixEntries force_of_mean, share_of_u, mean_of_u, share_of_mean;
  Block block;
  const auto add_cell = [&](std::size_t k, CellMatrix<Dim, per_cell>& matrix) {
    MixedCellMatrix<unknowns, splines> mixed;
    for_parts_of_cell(k, block, [&] {
      const bool finite = body_.materials[static_cast<std::size_t>(points.material_of_cell(k))]->info().finite_strain;
      typename Block::Row of_mean{}, of_share{};
      std::vector<TensorOf<K>> f(block.count);  // f of the points themselves
      for (std::size_t q = 0; q < block.count; ++q) f[q] = ChangeOfVolume<K>::deformation(block, finite, q);
      std::vector<typename SplineMeans<B, K>::OfCell> N(block.count);
      for (std::size_t q = 0; q < block.count; ++q) N[q] = splines_.N(block.first + q);
      const auto direct = [&](int column) {
        if (column < unknowns) {
          take_unit(k, column / Dim, column % Dim, block);
          std::fill_n(of_mean.begin(), block.count, 0.0);
          for (std::size_t q = 0; q < block.count; ++q) {
            const double dJ = ChangeOfVolume<K>::rate_at(block, f[q], q);
            for (int a = 0; a < splines; ++a)
              mixed.mean_of_u[a][column] += points.volume[block.first + q] * N[q][a] * dJ;
          }
        } else {
          for (auto& row : block.direction) std::fill_n(row.begin(), block.count, 0.0);
          for (std::size_t q = 0; q < block.count; ++q) of_mean[q] = N[q][column - unknowns];
        }
      };
      const auto take = [&](int column, const auto& force) {
        const bool of_u = column < unknowns;
        for (int row = 0; row < unknowns; ++row) {
          double& entry = of_u ? matrix[row][column] : mixed.force_of_mean[row][column - unknowns];
          entry += force[row];
        }
        for (int a = 0; a < splines; ++a) {
          double& entry = of_u ? mixed.share_of_u[a][column] : mixed.share_of_mean[a][column - unknowns];
          for (std::size_t q = 0; q < block.count; ++q) entry += N[q][a] * of_share[q];
        }
      };
      MeanDilatation<K, UnitPass<B, K>> mean({pass, of_mean, of_share}, finite);
      answer_columns(kind, dt, k, block, mean, unknowns + splines, direct, take);
    });
    for (int u = 0; u < unknowns; ++u) {
      dofs_->for_sources(Dim * weights_.function(k, u / Dim) + u % Dim, [&](int, int dof, double weight) {
        if (!dofs_->is_free(dof)) return;
        for (int a = 0; a < splines; ++a) {
          const int A = splines_.function(k, a);
          force_of_mean.emplace_back(dof, A, weight * mixed.force_of_mean[u][a]);
          share_of_u.emplace_back(A, dof, weight * mixed.share_of_u[a][u]);
          mean_of_u.emplace_back(A, dof, weight * mixed.mean_of_u[a][u]);
        }
      });
    }
    for (int a = 0; a < splines; ++a) {
      for (int b = 0; b < splines; ++b)
        share_of_mean.emplace_back(splines_.function(k, a), splines_.function(k, b), mixed.share_of_mean[a][b]);
    }
  };
  const SparseMatrix K_uu = assemble_whole_cells<B, K>(grid_, points, weights_, *dofs_, add_cell).free;
  return matrix_with_means(K_uu, splines_.matrix(), {force_of_mean, share_of_u, mean_of_u, share_of_mean});
}

}  // namespace stillpoint

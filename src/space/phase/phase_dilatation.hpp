// What the laws of a phase answer to: each point's own change of volume, or the mean of its cell's.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "space/kernels/gather_scatter_bilinear.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
auto MaterialPointPhase<B, K>::mean_dilatation([[maybe_unused]] std::size_t m,
                                               [[maybe_unused]] const Block& block) const {
  if constexpr (Dim == 2) {
    return MeanDilatation<K>(body_.points, volume_share_.data() + block.first,
                             body_.materials[m]->info().finite_strain);
  }
}

// block.H as the law of material m sees it.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::average_dilatation([[maybe_unused]] std::size_t m, [[maybe_unused]] Block& block) const {
  if constexpr (Dim == 2) {
    if (averages_dilatation()) mean_dilatation(m, block).average(block);
  }
}

// What averaging does to the committed state.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::commit_averages() {
  if constexpr (Dim == 2) {
    committed_averages_.resize(body_.points.size());
    nodal_force_.visit(committed_u_.data(), [this](std::size_t m, Block& block) {
      MeanDilatation<K> mean = mean_dilatation(m, block);
      mean.average(block);
      mean.write_effect(block, committed_averages_.data() + block.first);
    });
  }
}

// block.VP = V P. As PointMaterial::stress().
template <AxisBasis B, Kinematics K>
template <bool Increments>
double MaterialPointPhase<B, K>::stress(std::size_t m, Block& block, double dt, double* history,
                                        [[maybe_unused]] double* averages) const {
  const PointMaterial<K>& law = *body_.materials[m];
  const double* V = body_.points.volume.data();
  if constexpr (Dim == 2) {
    if (averages_dilatation()) {
      MeanDilatation<K> mean = mean_dilatation(m, block);
      if constexpr (Increments) {
        mean.average(block, committed_averages_.data() + block.first, averages ? averages + block.first : nullptr);
      } else {
        mean.average(block);
      }
      const double bad = law.stress(block, V, dt, history);
      mean.transform_stress(block);
      return bad;
    }
  }
  return law.stress(block, V, dt, history);
}

// block.VP = V δP
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::tangent(Tangent kind, std::size_t m, Block& block, double dt) const {
  const PointMaterial<K>& law = *body_.materials[m];
  const double* V = body_.points.volume.data();
  if constexpr (Dim == 2) {
    if (averages_dilatation()) {
      MeanDilatation<K> mean = mean_dilatation(m, block);
      mean.average(block, committed_averages_.data() + block.first, nullptr);
      law.stress(block, V, dt, scratch_history(m));
      mean.keep_stress(block);
      mean.average_direction(block);
      law.tangent(kind, block, V, dt);
      return mean.transform_tangent(block);
    }
  }
  law.tangent(kind, block, V, dt);
}

// As matrix(), column by column: the points of a cell answer together.
template <AxisBasis B, Kinematics K>
SparseMatrix MaterialPointPhase<B, K>::matrix_of_means([[maybe_unused]] Tangent kind,
                                                       [[maybe_unused]] double dt) const {
  if constexpr (Dim == 2) {
    using Cells = GatherScatter<B, K>;
    const MaterialPoints<Dim>& points = body_.points;
    Block block;
    std::vector<typename PointMaterial<K>::ModuliMatrix> A(Block::size);
    // block.direction of a unit of component i of the cell's local function b
    const auto take_unit = [&](std::size_t k, int b, int i) {
      for (auto& row : block.direction) std::fill_n(row.begin(), block.count, 0.0);
      for (std::size_t q = 0; q < block.count; ++q) {
        const auto dN = weights_.dN(k, block.first + q);
        for (int j = 0; j < Dim; ++j) block.direction[Dim * i + j][q] = dN[per_cell * j + b];
        if constexpr (K == Kinematics::axisymmetric)
          if (i == 0) block.direction[Dim * Dim][q] = dN[per_cell * Dim + b];
      }
    };
    // block.VP = V A : block.direction
    const auto answer = [&] {
      for (std::size_t q = 0; q < block.count; ++q) {
        for (int c = 0; c < components; ++c) {
          double dP = 0;
          for (int e = 0; e < components; ++e) dP += A[q][components * c + e] * block.direction[e][q];
          block.VP[c][q] = points.volume[block.first + q] * dP;
        }
      }
    };
    const auto add_part = [&](std::size_t k, CellMatrix<Dim, per_cell>& matrix) {
      const auto m = static_cast<std::size_t>(points.material_of_cell(k));
      const PointMaterial<K>& law = *body_.materials[m];
      const std::size_t end = block.first + block.count;
      Cells::template gather<true>(weights_, k, block.first, end, grid_u_.data(), committed_u_.data(), block.first,
                                   block.H, block.dH);
      MeanDilatation<K> mean = mean_dilatation(m, block);
      mean.average(block, committed_averages_.data() + block.first, nullptr);
      law.stress(block, points.volume.data(), dt, scratch_history(m));
      mean.keep_stress(block);
      for (std::size_t q = 0; q < block.count; ++q)
        A[q] = law.moduli(kind, block.H_at(q), block.dH_at(q), dt, block.first + q);
      for (int column = 0; column < Dim * per_cell; ++column) {
        take_unit(k, column / Dim, column % Dim);
        mean.average_direction(block);
        answer();
        mean.transform_tangent(block);
        std::array<double, static_cast<std::size_t>(Dim * per_cell)> force;
        Cells::scatter(weights_, k, block.first, end, block, force.data());
        for (int row = 0; row < Dim * per_cell; ++row) matrix[row][column] += force[row];
      }
    };
    const auto add_cell = [&](std::size_t k, CellMatrix<Dim, per_cell>& matrix) {
      block.first_cell = k;
      block.last_cell = k + 1;
      for (block.first = points.begin(k); block.first < points.end(k); block.first += block.count) {
        block.count = std::min(Block::size, points.end(k) - block.first);
        add_part(k, matrix);
      }
    };
    return assemble_whole_cells<B, K>(grid_, points, weights_, *dofs_, add_cell).free;
  } else {
    throw std::logic_error("there is no mean dilatation in one dimension");
  }
}

// For a stress whose history nobody reads.
template <AxisBasis B, Kinematics K>
double* MaterialPointPhase<B, K>::scratch_history(std::size_t m) const {
  return scratch_history_.empty() ? nullptr : scratch_history_[m].data();
}

}  // namespace stillpoint

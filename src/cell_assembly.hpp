// Sparse matrices assembled cell by cell from the material points.
#pragma once

#include <stillpoint/sparse_cholesky.hpp>

#include <array>
#include <vector>

#include "degrees_of_freedom.hpp"
#include "point_weights.hpp"

namespace stillpoint {

/// A matrix over all degrees of freedom, split at the free ones.
struct SplitMatrix {
  SparseMatrix free;        // (n × n)
  SparseMatrix prescribed;  // (n × supports): how supports act on free degrees of freedom
};

/// Row and column [Dim a + i]: local function a, component i.
template <int Dim, int PerCell>
using CellMatrix =
    std::array<std::array<double, static_cast<std::size_t>(Dim* PerCell)>, static_cast<std::size_t>(Dim* PerCell)>;

/// Σ_cells of add_point(p, cell matrix) over the cell's points; finish_cell(cell k, cell matrix) may change it as a
/// whole.
template <AxisBasis B, int Dim, class AddPoint, class FinishCell>
SplitMatrix assemble_cells(const MaterialPoints<Dim>& points, const PointWeights<B, Dim>& weights,
                           const DegreesOfFreedom& dofs, const AddPoint& add_point, const FinishCell& finish_cell) {
  constexpr int per_cell = PointWeights<B, Dim>::per_cell;
  std::vector<Eigen::Triplet<double>> free, prescribed;
  const int n = static_cast<int>(dofs.size());
  for (std::size_t k = 0; k < points.cell.size(); ++k) {
    CellMatrix<Dim, per_cell> matrix{};
    const auto begin = static_cast<std::size_t>(points.cell_begin[k]),
               end = static_cast<std::size_t>(points.cell_begin[k + 1]);
    for (std::size_t p = begin; p < end; ++p) add_point(p, matrix);
    finish_cell(k, matrix);
    std::array<int, static_cast<std::size_t>(Dim * per_cell)> number;
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < Dim; ++i) {
        number[Dim * a + i] = dofs.number[static_cast<std::size_t>(Dim * weights.function(begin, a) + i)];
      }
    }
    for (std::size_t r = 0; r < number.size(); ++r) {
      if (!dofs.is_free(number[r])) continue;
      for (std::size_t c = 0; c < number.size(); ++c) {
        if (matrix[r][c] == 0 || number[c] < 0) continue;
        if (dofs.is_free(number[c])) {
          free.emplace_back(number[r], number[c], matrix[r][c]);
        } else {
          prescribed.emplace_back(number[r], number[c] - n, matrix[r][c]);
        }
      }
    }
  }
  SplitMatrix split{SparseMatrix(n, n), SparseMatrix(n, static_cast<Eigen::Index>(dofs.prescribed.size()))};
  split.free.setFromTriplets(free.begin(), free.end());
  split.prescribed.setFromTriplets(prescribed.begin(), prescribed.end());
  return split;
}  // NOLINT(clang-analyzer-unix.Malloc): the analyzer loses sight of Eigen's destructor

/// M_ij = Σ_p m_p N_ip N_jp for each component.
template <AxisBasis B, int Dim>
SplitMatrix consistent_mass(const MaterialPoints<Dim>& points, const PointWeights<B, Dim>& weights,
                            const DegreesOfFreedom& dofs) {
  constexpr int per_cell = PointWeights<B, Dim>::per_cell;
  const auto add_point = [&](std::size_t p, CellMatrix<Dim, per_cell>& matrix) {
    for (int a = 0; a < per_cell; ++a) {
      for (int b = 0; b < per_cell; ++b) {
        const double m = points.mass[p] * weights.N(a, p) * weights.N(b, p);
        for (int i = 0; i < Dim; ++i) matrix[Dim * a + i][Dim * b + i] += m;
      }
    }
  };
  return assemble_cells<B, Dim>(points, weights, dofs, add_point, [](std::size_t, auto&) {});
}

/// The diagonal of a lumped mass that keeps each cell's mass, (n):
///   row sums Σ_p m_p N_ip where the basis is a partition of unity; otherwise, cell by cell, the diagonal of the
///   consistent mass scaled so that its values (not its slopes) sum to the cell's mass [Hinton, Rock, Zienkiewicz
///   1976].
template <AxisBasis B, int Dim>
std::vector<double> lumped_mass(const MaterialPoints<Dim>& points, const PointWeights<B, Dim>& weights,
                                const DegreesOfFreedom& dofs) {
  using Basis = TensorBasis<B, Dim>;
  std::vector<double> diagonal(dofs.size(), 0.0);
  for (std::size_t k = 0; k < points.cell.size(); ++k) {
    const auto begin = static_cast<std::size_t>(points.cell_begin[k]),
               end = static_cast<std::size_t>(points.cell_begin[k + 1]);
    std::array<double, Basis::per_cell> corner{};
    double cell_mass = 0, values_mass = 0;
    for (std::size_t p = begin; p < end; ++p) {
      cell_mass += points.mass[p];
      for (int a = 0; a < Basis::per_cell; ++a) {
        const double N = weights.N(a, p);
        corner[a] += points.mass[p] * (B::partition_of_unity ? N : N * N);
      }
    }
    for (int a = 0; a < Basis::per_cell; ++a) values_mass += Basis::is_value(a) ? corner[a] : 0;
    const double scale = B::partition_of_unity ? 1 : cell_mass / values_mass;
    for (int a = 0; a < Basis::per_cell; ++a) {
      for (int i = 0; i < Dim; ++i) {
        const int dof = dofs.number[static_cast<std::size_t>(Dim * weights.function(begin, a) + i)];
        if (dofs.is_free(dof)) diagonal[static_cast<std::size_t>(dof)] += scale * corner[a];
      }
    }
  }
  return diagonal;
}

}  // namespace stillpoint

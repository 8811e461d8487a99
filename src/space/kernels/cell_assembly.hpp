// Sparse matrices assembled cell by cell from the material points.
#pragma once

#include <array>
#include <vector>

#include "linalg/sparse_cholesky.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/kernels/point_weights.hpp"

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

/// Σ_cells of add_point(cell k, point p, cell matrix) over the cell's points.
template <AxisBasis B, Kinematics K, class AddPoint>
SplitMatrix assemble_cells(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights,
                           const DegreesOfFreedom& dofs, const AddPoint& add_point) {
  constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  std::vector<Eigen::Triplet<double>> free, prescribed;
  const int n = static_cast<int>(dofs.size());
  for (std::size_t k = 0; k < points.cells(); ++k) {
    CellMatrix<dim, per_cell> matrix{};
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) add_point(k, p, matrix);
    std::array<int, static_cast<std::size_t>(dim * per_cell)> number;
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < dim; ++i) {
        number[dim * a + i] = dofs.number[static_cast<std::size_t>(dim * weights.function(k, a) + i)];
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
template <AxisBasis B, Kinematics K>
SplitMatrix consistent_mass(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights,
                            const DegreesOfFreedom& dofs) {
  constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  const auto add_point = [&](std::size_t k, std::size_t p, CellMatrix<dim, per_cell>& matrix) {
    const auto N = weights.N(k, p);
    for (int a = 0; a < per_cell; ++a) {
      for (int b = 0; b < per_cell; ++b) {
        const double m = points.mass[p] * N[a] * N[b];
        for (int i = 0; i < dim; ++i) matrix[dim * a + i][dim * b + i] += m;
      }
    }
  };
  return assemble_cells<B, K>(points, weights, dofs, add_point);
}

}  // namespace stillpoint

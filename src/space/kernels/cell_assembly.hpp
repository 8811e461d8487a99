// Sparse matrices assembled cell by cell from the material points.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/SparseCore>

#include "base/stop_request.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/matrix_entries.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/kernels/point_weights.hpp"

namespace stillpoint {

/// The matrix of a cell, with local function a, component i in row and column [Dim a + i].
template <int Dim, int PerCell>
using CellMatrix =
    std::array<std::array<double, static_cast<std::size_t>(Dim* PerCell)>, static_cast<std::size_t>(Dim* PerCell)>;

/// A matrix between neighbouring functions of a tensor-product basis, in blocks of components. Two functions of a cell
/// are less than B::per_cell apart along each axis: for each column function there is a block for every such distance,
/// in ascending order of the row function.
template <AxisBasis B, int Dim>
class NeighbourMatrix {
  static constexpr int reach = B::per_cell - 1, span = 2 * reach + 1;
  static constexpr int neighbours = power(span, Dim), per_cell = power(B::per_cell, Dim);

 public:
  /// functions: the number of all, in fields one after the other.
  NeighbourMatrix(const Grid<Dim>& grid, std::size_t functions) {
    int stride = 1;
    for (int d = 0; d < Dim; ++d) {
      for (int k = 0; k < neighbours; ++k) offset_[k] += stride * (k / power(span, d) % span - reach);
      stride *= TensorBasis<B, Dim>::count_along(grid, d);
    }
    entry_.assign(functions * neighbours * Dim * Dim, untouched);
  }

  /// Adds a cell's matrix. function(a): global number of the cell's local function a. Entries of 0 leave no trace.
  template <class Function>
  void add(const CellMatrix<Dim, per_cell>& matrix, const Function& function) {
    for (int b = 0; b < per_cell; ++b) add_columns(matrix, b, function(b));
  }
  /// Adds those columns alone that belong to the cell's local function b, which has this global number.
  void add_columns(const CellMatrix<Dim, per_cell>& matrix, int b, int function) {
    double* column = entry_.data() + blocks_of(function);
    for (int a = 0; a < per_cell; ++a) {
      int neighbour = 0;
      for (int d = Dim - 1; d >= 0; --d) neighbour = neighbour * span + along(a, d) - along(b, d) + reach;
      for (int j = 0; j < Dim; ++j) {
        for (int i = 0; i < Dim; ++i) {
          const double value = matrix[Dim * a + i][Dim * b + j];
          if (value != 0) column[(j * neighbours + neighbour) * Dim + i] += value;
        }
      }
    }
  }
  /// Completes the columns of functions that other ranks have summed.
  void complete(const CornerSum& corner_sum) {
    corner_sum.complete(entry_.data(), static_cast<std::size_t>(neighbours * Dim * Dim));
  }

  /// The matrix over the free unknowns, with extended functions expressed by their sources.
  SplitMatrix extended(const DegreesOfFreedom& dofs) const {
    MatrixEntries of_all;
    for (std::size_t unknown = 0; unknown < dofs.number.size(); ++unknown) {
      heed_stop_request();
      const int column = dofs.number[unknown];
      if (column < 0) continue;
      visit_all(static_cast<int>(unknown), [&](int row_unknown, double value) {
        const int row = dofs.number[static_cast<std::size_t>(row_unknown)];
        if (row >= 0) of_all.emplace_back(row, column, value);
      });
    }
    return over_free_unknowns(of_all, dofs);
  }

  /// The columns of the given unknowns, the rows of the free ones.
  Eigen::SparseMatrix<double> columns(const std::vector<int>& unknowns, const DegreesOfFreedom& dofs) const {
    Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(dofs.size()),
                                       static_cast<Eigen::Index>(unknowns.size()));
    const auto count = [&](std::size_t c) {
      int entries = 0;
      visit(unknowns[c], dofs, [&](int, double) { ++entries; });
      return entries;
    };
    int* begin = matrix.outerIndexPtr();
    for (std::size_t c = 0; c < unknowns.size(); ++c) {
      heed_stop_request();
      begin[c + 1] = begin[c] + count(c);
    }
    matrix.resizeNonZeros(begin[unknowns.size()]);
    for (std::size_t c = 0; c < unknowns.size(); ++c) {
      int next = begin[c];
      visit(unknowns[c], dofs, [&](int row, double value) {
        matrix.innerIndexPtr()[next] = row;
        matrix.valuePtr()[next++] = value;
      });
    }
    return matrix;
  }

 private:
  // Marks an entry that nothing was added to: −0 + x = x for every x, and no sum of non-zero entries is −0.
  static constexpr double untouched = -0.0;

  static constexpr int along(int a, int d) { return a / power(B::per_cell, d) % B::per_cell; }
  static std::size_t blocks_of(int function) { return static_cast<std::size_t>(function) * neighbours * Dim * Dim; }

  /// Calls take(free row, value) for a column's entries, rows ascending.
  template <class Take>
  void visit(int unknown, const DegreesOfFreedom& dofs, const Take& take) const {
    visit_all(unknown, [&](int row_unknown, double value) {
      const int row = dofs.number[static_cast<std::size_t>(row_unknown)];
      if (dofs.is_free(row)) take(row, value);
    });
  }
  /// Calls take(unknown of the row, value) for a column's entries, in ascending order.
  template <class Take>
  void visit_all(int unknown, const Take& take) const {
    const int function = unknown / Dim;
    const double* column = entry_.data() + blocks_of(function) + unknown % Dim * neighbours * Dim;
    for (int k = 0; k < neighbours; ++k) {
      for (int i = 0; i < Dim; ++i) {
        const double value = column[k * Dim + i];
        if (value == 0 && std::signbit(value)) continue;
        take(Dim * (function + offset_[k]) + i, value);
      }
    }
  }

  std::array<int, neighbours> offset_{};  // row function minus column function
  std::vector<double> entry_;             // (functions × Dim × neighbours × Dim): column, component, row, component
};

template <AxisBasis B, Kinematics K>
using AddCell = std::function<void(std::size_t k, CellMatrix<dimensions(K), PointWeights<B, K>::per_cell>& matrix)>;

/// The sum of cell matrices where ranks share the cells. A column belongs to the rank of its function; those to which
/// cells of several ranks add wait until all are there, and then are added in the order of the cells.
template <AxisBasis B, int Dim>
class SumOfSharedCells {
  static constexpr int per_cell = power(B::per_cell, Dim);

 public:
  /// Both arguments must outlive this object. Does nothing unless ranks share the cells.
  SumOfSharedCells(const CornerSum& corner_sum, NeighbourMatrix<B, Dim>& sum) : corner_sum_(corner_sum), sum_(sum) {
    if (const Ranks* ranks = corner_sum.ranks()) to_.resize(static_cast<std::size_t>(ranks->count()));
  }
  template <class Function>
  void add(const CellMatrix<Dim, per_cell>& matrix, const CellPlace& of, const Function& function) {
    const SharedCorners& shared = *corner_sum_.shared();
    for (int b = 0; b < per_cell; ++b) {
      const int f = function(b);
      if (shared.is_of_others_too(f)) {
        to_[static_cast<std::size_t>(shared.owner(f))].push_back({f, b, of, matrix});
      } else {
        sum_.add_columns(matrix, b, f);
      }
    }
  }
  void complete() {
    if (!corner_sum_.shared()) return;
    std::vector<Bytes> bytes;
    for (const std::vector<Columns>& columns : to_) bytes.push_back(bytes_of(columns));
    std::vector<Columns> shared;
    for (const Bytes& from : corner_sum_.ranks()->deliver(bytes)) append_from(from, shared);
    std::ranges::stable_sort(shared, {}, &Columns::of);
    for (const Columns& columns : shared) sum_.add_columns(columns.matrix, columns.local, columns.function);
    sum_.complete(corner_sum_);
  }

 private:
  // The columns of a function in a cell's matrix.
  struct Columns {
    int function = 0, local = 0;
    CellPlace of;
    CellMatrix<Dim, per_cell> matrix;
  };

  const CornerSum& corner_sum_;
  NeighbourMatrix<B, Dim>& sum_;
  std::vector<std::vector<Columns>> to_;
};

/// The sum over the cells of the matrices that add_cell(cell k, cell matrix) makes.
template <AxisBasis B, Kinematics K>
SplitMatrix assemble_whole_cells(const Grid<dimensions(K)>& grid, const MaterialPoints<dimensions(K)>& points,
                                 const PointWeights<B, K>& weights, const CornerSum& corner_sum,
                                 const DegreesOfFreedom& dofs, const AddCell<B, K>& add_cell) {
  constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  NeighbourMatrix<B, dim> sum(grid, dofs.number.size() / dim);
  SumOfSharedCells<B, dim> shared(corner_sum, sum);
  for (std::size_t k = 0; k < points.cells(); ++k) {
    if (!corner_sum.shared()) heed_stop_request();  // of which ranks do not have as many
    CellMatrix<dim, per_cell> matrix{};
    add_cell(k, matrix);
    if (corner_sum.shared()) {
      shared.add(matrix, place_of_cell(points, k), [&](int a) { return weights.function(k, a); });
    } else {
      sum.add(matrix, [&](int a) { return weights.function(k, a); });
    }
  }
  shared.complete();
  if (!dofs.extended.empty()) return sum.extended(dofs);
  return {sum.columns(dofs.free, dofs), sum.columns(dofs.prescribed, dofs)};
}

/// The sum over the cells of the matrices that add_point(cell k, point p, cell matrix) makes for the cell's points.
template <AxisBasis B, Kinematics K, class AddPoint>
SplitMatrix assemble_cells(const Grid<dimensions(K)>& grid, const MaterialPoints<dimensions(K)>& points,
                           const PointWeights<B, K>& weights, const CornerSum& corner_sum, const DegreesOfFreedom& dofs,
                           const AddPoint& add_point) {
  return assemble_whole_cells<B, K>(
      grid, points, weights, corner_sum, dofs,
      [&](std::size_t k, CellMatrix<dimensions(K), PointWeights<B, K>::per_cell>& matrix) {
        for (std::size_t p = points.begin(k); p < points.end(k); ++p) add_point(k, p, matrix);
      });
}

/// The consistent mass M_ij = Σ_p m_p N_ip N_jp for each component.
template <AxisBasis B, Kinematics K>
SplitMatrix consistent_mass(const Grid<dimensions(K)>& grid, const MaterialPoints<dimensions(K)>& points,
                            const PointWeights<B, K>& weights, const CornerSum& corner_sum,
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
  return assemble_cells<B, K>(grid, points, weights, corner_sum, dofs, add_point);
}

}  // namespace stillpoint

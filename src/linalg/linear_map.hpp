// Linear operators, given by their action on a vector.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <functional>

#include <Eigen/SparseCore>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// y = A x or y = B⁻¹ x; x, y: (n), distinct.
using LinearMap = std::function<void(ConstVec x, Vec y)>;

/// The product with A, of which it keeps a copy stored by rows. All threads take a row at a time: the same bits for any
/// number of them.
inline LinearMap row_product(const SparseMatrix& A) {
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  return [rows = Rows(A)](ConstVec x, Vec y) {
    for_each_index(y.size(), [&, begin = rows.outerIndexPtr(), column = rows.innerIndexPtr(),
                              value = rows.valuePtr()](std::size_t i) {
      double sum = 0;
      for (auto k = begin[i]; k < begin[i + 1]; ++k) sum += value[k] * x[static_cast<std::size_t>(column[k])];
      y[i] = sum;
    });
  };
}

}  // namespace stillpoint

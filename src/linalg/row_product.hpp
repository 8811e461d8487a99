// y = A x with a sparse matrix, a row at a time by all threads: the same bits for any number of them.
#pragma once

#include <stillpoint/sparse_matrix.hpp>

#include <Eigen/SparseCore>

#include "base/parallel_loop.hpp"
#include "linalg/linear_map.hpp"

namespace stillpoint {

/// The product with A, of which it keeps a copy stored by rows.
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

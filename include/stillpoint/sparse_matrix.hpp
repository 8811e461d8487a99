// Sparse matrices by name alone: who looks into one includes <Eigen/SparseCore>.
#pragma once

namespace Eigen {
template <typename Scalar, int Options, typename StorageIndex>
class SparseMatrix;
}

namespace stillpoint {

/// Compressed by columns. Symmetric ones are stored whole, both triangles, so that a product needs no special case.
using SparseMatrix = Eigen::SparseMatrix<double, 0, int>;

}  // namespace stillpoint

// Forward declaration of sparse matrices: code that uses one includes <Eigen/SparseCore>.
#pragma once

namespace Eigen {
template <typename Scalar, int Options, typename StorageIndex>
class SparseMatrix;
}

namespace stillpoint {

/// A matrix compressed by columns. A symmetric one is stored whole, both triangles, so that a product needs no special
/// case.
using SparseMatrix = Eigen::SparseMatrix<double, 0, int>;

}  // namespace stillpoint

// Tensors in space as matrices of Eigen's.
#pragma once

#include <stillpoint/tensor.hpp>

#include <Eigen/Core>

namespace stillpoint::test {

inline Eigen::Matrix3d matrix_of(const SpaceTensor& A) {
  Eigen::Matrix3d matrix;
  matrix << A.xx, A.xy, A.xz, A.yx, A.yy, A.yz, A.zx, A.zy, A.zz;
  return matrix;
}
inline SpaceTensor tensor_of_matrix(const Eigen::Matrix3d& A) {
  return {A(0, 0), A(0, 1), A(0, 2), A(1, 0), A(1, 1), A(1, 2), A(2, 0), A(2, 1), A(2, 2)};
}

}  // namespace stillpoint::test

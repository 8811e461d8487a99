// What the tests of sparse factors share: a right-hand side, and how far a solution is off.
#pragma once

#include <stillpoint/sparse_matrix.hpp>

#include <cstddef>
#include <vector>

#include <Eigen/SparseCore>

namespace stillpoint::test {

inline std::vector<double> ramp(std::size_t n) {
  std::vector<double> b(n);
  for (std::size_t i = 0; i < n; ++i) b[i] = 1 + static_cast<double>(i % 7);
  return b;
}

/// ‖A x − b‖/‖b‖
inline double residual(const SparseMatrix& A, const std::vector<double>& x, const std::vector<double>& b) {
  const Eigen::Map<const Eigen::VectorXd> X(x.data(), A.rows()), B(b.data(), A.rows());
  return (A * X - B).norm() / B.norm();
}

}  // namespace stillpoint::test

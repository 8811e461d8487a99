// The share of loads that follow the deformation in a product with the tangent.
#pragma once

#include <stillpoint/types.hpp>

#include <Eigen/SparseCore>

namespace stillpoint {

/// Computes y −= s A x.
inline void subtract_product(double s, const Eigen::SparseMatrix<double>& A, ConstVec x, Vec y) {
  if (A.nonZeros() == 0) return;
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::Map<Eigen::VectorXd>(y.data(), n) -= s * (A * Eigen::Map<const Eigen::VectorXd>(x.data(), n));
}

}  // namespace stillpoint

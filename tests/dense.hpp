// Eigen's dense spectra, compiled once: what spectra of sparse matrices are compared with.
#pragma once

#include <Eigen/Core>

namespace stillpoint::test {

/// λ of K x = λ M x in ascending order; K and M symmetric, M positive definite.
Eigen::VectorXd dense_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
/// λ of A x = λ x in ascending order; A symmetric.
Eigen::VectorXd dense_eigenvalues(const Eigen::MatrixXd& A);

}  // namespace stillpoint::test

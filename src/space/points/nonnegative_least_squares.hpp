// Least squares with a sign.
#pragma once

#include <Eigen/Core>

namespace stillpoint {

/// Solves min ‖E x − f‖ with x ≥ 0 [Lawson and Hanson 1974, algorithm NNLS (23.10)]. Columns of E that depend on those
/// that are taken already are left out, so that no more than rank(E) of x are positive. Time: O(m n) a column that is
/// taken, of E (m × n).
Eigen::VectorXd solve_nnls(const Eigen::MatrixXd& E, const Eigen::VectorXd& f);

}  // namespace stillpoint

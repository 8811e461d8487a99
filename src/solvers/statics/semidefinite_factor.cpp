#include "solvers/statics/semidefinite_factor.hpp"

#include <cmath>

#include <Eigen/SparseCore>

#include "linalg/krylov.hpp"
#include "linalg/linear_map.hpp"
#include "linalg/sparse_lu.hpp"
#include "solvers/spectrum/largest_entry.hpp"

namespace stillpoint {
namespace {

constexpr double accuracy = 1e-11;  // relative to b; the error from K + σ M's own factor is far below it
constexpr int most_iterations = 60;

SparseMatrix shifted(const SparseMatrix& K, const Mass& M) {
  constexpr double share = 1e-9;
  return K + share * largest_entry(K, M) * M.matrix();
}

// Whether K + share diag K is positive definite: a test that no scaling of the unknowns changes.
bool is_definite_but_for_rounding(const SparseMatrix& K) {
  constexpr double share = 1e-13;
  SparseMatrix raised = K;
  for (Eigen::Index k = 0; k < raised.rows(); ++k) raised.coeffRef(k, k) *= 1 + share;
  return SparseCholesky(raised).positive_definite();
}

}  // namespace

SemidefiniteFactor::SemidefiniteFactor(const SparseMatrix& K, const Mass& M) : K_(K) {
  factor_.emplace(K);
  semidefinite_ = factor_->positive_definite();
  if (semidefinite_ && factor_->pivot_ratio() > suspicious_pivot_ratio) return;
  if (!M.has_product() || (!semidefinite_ && !is_definite_but_for_rounding(K))) return;
  SparseCholesky factor(shifted(K, M));
  if (!factor.positive_definite()) return;
  factor_.reset();  // there may be no room for both
  shifted_.emplace(std::move(factor));
  semidefinite_ = true;
}

bool SemidefiniteFactor::solve(ConstVec b, Vec x) const {
  if (!shifted_) {
    factor_->solve(b, x);
    return true;
  }
  const LinearMap by_factor = [this](ConstVec r, Vec z) { shifted_->solve(r, z); };
  return conjugate_gradients(row_product(K_), by_factor, b, x, accuracy, most_iterations).converged;
}

bool solve_unsymmetric_singular(const SparseMatrix& K, const Mass& M, ConstVec b, Vec x) {
  if (!M.has_product()) return false;
  const SparseLu factor(shifted(K, M));
  if (!factor.regular()) return false;
  const LinearMap by_factor = [&factor](ConstVec r, Vec z) { factor.solve(r, z); };
  return gmres(row_product(K), by_factor, b, x, accuracy, most_iterations).converged;
}

}  // namespace stillpoint

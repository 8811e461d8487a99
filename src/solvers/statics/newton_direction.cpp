#include "solvers/statics/newton_direction.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "linalg/krylov.hpp"
#include "linalg/linear_map.hpp"
#include "linalg/power_iteration.hpp"
#include "linalg/sparse_lu.hpp"
#include "solvers/statics/subtract_product.hpp"

namespace stillpoint {
namespace {

bool symmetric(const SparseMatrix& K, double tolerance) {
  return (K - SparseMatrix(K.transpose())).norm() <= tolerance * K.norm();
}

bool same(const SparseMatrix& A, const SparseMatrix& B) {
  const auto all = [](const SparseMatrix& matrix, const auto* values) {
    return std::span(values, static_cast<std::size_t>(matrix.nonZeros()));
  };
  return A.rows() == B.rows() && A.nonZeros() == B.nonZeros() &&
         std::ranges::equal(all(A, A.valuePtr()), all(B, B.valuePtr())) &&
         std::ranges::equal(all(A, A.innerIndexPtr()), all(B, B.innerIndexPtr()));
}

}  // namespace

bool NewtonDirection::find(double s, ConstVec u, ConstVec from) {
  indefinite_ = false;
  const SparseMatrix of_loads = system_.tangents().of_loads(t_, u);
  if (options_.solver == LinearSolver::iterative) {
    const LinearMap by_laws = [&](ConstVec x, Vec Kx) {
      system_.tangents().apply(Tangent::consistent, t_, u, x, Kx);
      subtract_product(s, of_loads, x, Kx);
    };
    const LinearMap apply_K = options_.assembles ? row_product(consistent_matrix(s, u, from, of_loads)) : by_laws;
    const bool may_be_unsymmetric = system_.history_dependent() || of_loads.nonZeros() > 0;
    return by_iterations(apply_K, !may_be_unsymmetric || looks_symmetric(apply_K));
  }
  const SparseMatrix K = consistent_matrix(s, u, from, of_loads);
  if (options_.solver == LinearSolver::cholesky) return by_cholesky(0.5 * (K + SparseMatrix(K.transpose())));
  if (options_.solver == LinearSolver::automatic && symmetric(K, options_.symmetry)) {
    if (by_cholesky(K)) return true;
    indefinite_ = !semidefinite_;
  }
  return by_lu(K);
}

SparseMatrix NewtonDirection::consistent_matrix(double s, ConstVec u, ConstVec from,
                                                const SparseMatrix& of_loads) const {
  const Tangents& of = system_.tangents();
  SparseMatrix K = from.empty() ? of.matrix(Tangent::consistent, t_, u) : of.matrix_ahead(t_, u, from);
  if (of_loads.nonZeros() > 0) K -= s * of_loads;
  return K;
}

bool NewtonDirection::find_elastic(ConstVec u) {
  if (options_.solver == LinearSolver::iterative) {
    return by_iterations([&](ConstVec x, Vec Kx) { system_.tangents().apply(Tangent::elastic, t_, u, x, Kx); }, true);
  }
  return by_cholesky(system_.tangents().matrix(Tangent::elastic, t_, u));
}

// Solves K du = Q. False if K is indefinite, or if it is singular and Q drives a motion that it does not resist.
bool NewtonDirection::by_cholesky(const SparseMatrix& K) {
  is_used_again_ = factor_ && same(K, factorised_);
  if (!is_used_again_) {
    forget_factor();  // released first, as there may be no room for two
    factorised_ = K;
    factor_.emplace(factorised_, system_.mass());
    ++report_.cholesky_factorisations;
    report_.factor_bytes = std::max(report_.factor_bytes, factor_->bytes());
  }
  semidefinite_ = factor_->semidefinite();
  const bool found = semidefinite_ && factor_->solve(balance_.Q.span(), du_);
  if (!found) forget_factor();
  return found;
}

void NewtonDirection::forget_factor() {
  factor_.reset();
  factorised_ = {};
}

bool NewtonDirection::by_lu(const SparseMatrix& K) {
  const SparseLu factor(K);
  ++report_.lu_factorisations;
  report_.factor_bytes = std::max(report_.factor_bytes, factor.bytes());
  if (factor.regular() && factor.pivot_ratio() > suspicious_pivot_ratio) {
    factor.solve(balance_.Q.span(), du_);
    return true;
  }
  if (solve_unsymmetric_singular(K, system_.mass(), balance_.Q.span(), du_)) return true;
  if (factor.regular()) factor.solve(balance_.Q.span(), du_);
  return factor.regular();
}

bool NewtonDirection::by_iterations(const LinearMap& K, bool is_symmetric) {
  const std::size_t n = du_.size();
  const int most = options_.max_cg_iterations > 0 ? options_.max_cg_iterations : 10 * static_cast<int>(n);
  const double forcing = std::min(0.1, balance_.residual());
  const LinearMap B = options_.preconditioner ? options_.preconditioner : division_by(system_.mass().diagonal());
  const IterativeResult result = is_symmetric
                                     ? stillpoint::conjugate_gradients(K, B, balance_.Q.span(), du_, forcing, most)
                                     : gmres(K, B, balance_.Q.span(), du_, forcing, most);
  report_.tangent_products += result.iterations;
  return result.converged;
}

// Whether x·K y = y·K x for the out-of-balance force x and an unrelated vector y.
bool NewtonDirection::looks_symmetric(const LinearMap& K) {
  const VectorSpace vectors;
  Vector y = vectors.make(du_.size()), Kx = vectors.make(du_.size()), Ky = vectors.make(du_.size());
  std::ranges::copy(start_vector(du_.size()), y.span().begin());
  K(balance_.Q.span(), Kx.span());
  K(y.span(), Ky.span());
  report_.tangent_products += 2;
  constexpr double rounding = 1e-10;
  return std::abs(dot(balance_.Q, Ky) - dot(y, Kx)) <= rounding * norm(balance_.Q) * norm(Ky);
}

}  // namespace stillpoint

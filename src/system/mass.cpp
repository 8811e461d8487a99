#include <stillpoint/mass.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "linalg/power_iteration.hpp"
#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {
namespace {

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

Eigen::Index index(std::size_t n) { return static_cast<Eigen::Index>(n); }

[[noreturn]] void refuse_consistent(std::size_t n, const std::string& why) {
  throw std::invalid_argument(fmt::format(
      "the consistent mass matrix of {} degrees of freedom is not positive definite ({}): there are too few "
      "material points for the basis. Use more points per cell or mass.kind = \"lumped\"",
      n, why));
}

// The smallest eigenvalue of D⁻¹M, D = diag M, from above and within a few per cent: how near to singular M is,
// whatever its units. Too few points make an exact zero, which rounding can hide from the factorisation.
double smallest_scaled_eigenvalue(ConstVec diagonal, const SparseCholesky& factor) {
  const auto apply_D = [&](ConstVec x, Vec y) {
    std::transform(x.begin(), x.end(), diagonal.begin(), y.begin(), std::multiplies<>());
  };
  const auto solve_M = [&](ConstVec x, Vec y) { factor.solve(x, y); };
  return 1 / power_iteration(diagonal.size(), apply_D, solve_M, 0.1, 10).eigenvalue;
}

}  // namespace

Mass Mass::lumped(std::vector<double> diagonal) {
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    if (!(diagonal[i] > 0) || !std::isfinite(diagonal[i])) {
      throw std::invalid_argument(fmt::format(
          "the lumped mass of degree of freedom {} of {} is {}, not positive: no material point gives it mass", i,
          diagonal.size(), diagonal[i]));
    }
  }
  Mass mass;
  mass.diagonal_ = std::move(diagonal);
  return mass;
}

struct Mass::Consistent {
  explicit Consistent(const SparseMatrix& M) : matrix(M), factor(matrix) {}

  SparseMatrix matrix;
  SparseCholesky factor;
};

Mass Mass::consistent(const SparseMatrix& matrix) {
  Mass mass;
  mass.diagonal_.resize(static_cast<std::size_t>(matrix.rows()));
  Map(mass.diagonal_.data(), matrix.rows()) = matrix.diagonal();
  mass.consistent_ = std::make_shared<const Consistent>(matrix);
  const SparseCholesky& factor = mass.consistent_->factor;
  if (!factor.positive_definite()) refuse_consistent(mass.size(), "its Cholesky factorisation breaks down");
  constexpr double singular = 1e-12;  // M⁻¹ would keep fewer than four digits
  if (const double s = mass.size() > 0 ? smallest_scaled_eigenvalue(mass.diagonal_, factor) : 1; !(s > singular)) {
    refuse_consistent(mass.size(), fmt::format("singular to rounding: λ_min(D⁻¹M) = {:.1e} ≤ {:.0e}", s, singular));
  }
  return mass;
}

SparseMatrix Mass::matrix() const {
  if (!is_lumped()) return consistent_->matrix;
  SparseMatrix diagonal_matrix(index(size()), index(size()));
  diagonal_matrix.setIdentity();
  std::copy(diagonal_.begin(), diagonal_.end(), diagonal_matrix.valuePtr());
  return diagonal_matrix;
}

void Mass::apply(ConstVec x, Vec y) const {
  if (is_lumped()) {
    for_each_index(size(), [=, m = diagonal_.data()](std::size_t i) { y[i] = m[i] * x[i]; });
  } else {  // M = Mᵀ: by rows, y_i = Σ_j M_ij x_j, which writes each y_i once
    Map(y.data(), index(y.size())).noalias() = consistent_->matrix.transpose() * ConstMap(x.data(), index(x.size()));
  }
}

void Mass::solve(ConstVec b, Vec x) const {
  if (is_lumped()) {
    for_each_index(size(), [=, m = diagonal_.data()](std::size_t i) { x[i] = b[i] / m[i]; });
  } else {
    consistent_->factor.solve(b, x);
  }
}

}  // namespace stillpoint

#include <stillpoint/mass.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "linalg/component_cholesky.hpp"
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

// The smallest eigenvalue of D⁻¹M, D = diag M, from above and within a few per cent: it tells how near to singular M
// is, whatever its units. Too few points make an exact zero, which rounding can hide from the factorisation.
double smallest_scaled_eigenvalue(ConstVec diagonal, const SparseCholesky& factor) {
  const auto apply_D = [&](ConstVec x, Vec y) {
    std::transform(x.begin(), x.end(), diagonal.begin(), y.begin(), std::multiplies<>());
  };
  const auto solve_M = [&](ConstVec x, Vec y) { factor.solve(x, y); };
  return 1 / power_iteration(diagonal.size(), apply_D, solve_M, 0.1, 10).eigenvalue;
}

}  // namespace

// The coupled part of M. Only the degrees of freedom that it couples are solved for by its factor; all others by the
// diagonal.
class Mass::Relative {
 public:
  /// diagonal: that of M.
  Relative(const std::vector<RelativeInertia>& terms, ConstVec diagonal)
      : terms_(terms), factor_(coupled_entries(diagonal), diagonal.size()), work_(factor_.unknowns().size()) {
    if (factor_.positive_definite()) return;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const int dof : factor_.unknowns()) {
      least = std::min(least, diagonal[static_cast<std::size_t>(dof)]);
      most = std::max(most, diagonal[static_cast<std::size_t>(dof)]);
    }
    throw std::invalid_argument(fmt::format(
        "the lumped mass is not positive definite to rounding: light nodes were given so much inertia that its "
        "diagonal reaches from {:.1e} to {:.1e}; expected smaller loads or cells, or more points per cell",
        least, most));
  }

  /// Adds inertia q_i² to each M_ii.
  static void add_to_diagonal(const std::vector<RelativeInertia>& terms, Vec diagonal) {
    for (const RelativeInertia& term : terms) {
      diagonal[static_cast<std::size_t>(term.dof)] += term.inertia;
      for (std::size_t k = 0; k < static_cast<std::size_t>(term.masters); ++k)
        diagonal[static_cast<std::size_t>(term.master[k])] += term.inertia * term.weight[k] * term.weight[k];
    }
  }
  /// Calls take(i, j, M_ij) for i ≠ j, both triangles; more than once for a pair that several terms couple.
  template <class Take>
  void for_each_off_diagonal(const Take& take) const {
    const auto both = [&](int i, int j, double value) {
      take(i, j, value);
      take(j, i, value);
    };
    for (const RelativeInertia& term : terms_) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(term.masters); ++k) {
        both(term.dof, term.master[k], -term.inertia * term.weight[k]);
        for (std::size_t l = 0; l < k; ++l)
          both(term.master[k], term.master[l], term.inertia * term.weight[k] * term.weight[l]);
      }
    }
  }
  /// Adds the off-diagonal part of M x to y.
  void add_off_diagonal(ConstVec x, Vec y) const {
    for_each_off_diagonal(
        [&](int i, int j, double value) { y[static_cast<std::size_t>(i)] += value * x[static_cast<std::size_t>(j)]; });
  }
  void take(ConstVec b) const {
    const std::span<const int> dofs = factor_.unknowns();
    for (std::size_t k = 0; k < dofs.size(); ++k) work_[k] = b[static_cast<std::size_t>(dofs[k])];
  }
  /// x = M⁻¹ b at the coupled degrees of freedom, for the b that take() has copied.
  void solve(Vec x) const {
    const std::span<const int> dofs = factor_.unknowns();
    factor_.solve(work_, work_);
    for (std::size_t k = 0; k < dofs.size(); ++k) x[static_cast<std::size_t>(dofs[k])] = work_[k];
  }
  void decouple(Vec b, ConstVec diagonal) const {
    take(b);
    solve(b);
    for (const int dof : factor_.unknowns())
      b[static_cast<std::size_t>(dof)] *= diagonal[static_cast<std::size_t>(dof)];
  }
  double energy(ConstVec v) const {
    double sum = 0;
    for (const RelativeInertia& term : terms_) {
      double q = v[static_cast<std::size_t>(term.dof)];
      for (std::size_t k = 0; k < static_cast<std::size_t>(term.masters); ++k)
        q -= term.weight[k] * v[static_cast<std::size_t>(term.master[k])];
      sum += 0.5 * term.inertia * q * q;
    }
    return sum;
  }

 private:
  std::vector<Eigen::Triplet<double>> coupled_entries(ConstVec diagonal) const {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<char> is_coupled(diagonal.size(), 0);
    for_each_off_diagonal([&](int i, int j, double value) {
      entries.emplace_back(i, j, value);
      is_coupled[static_cast<std::size_t>(i)] = 1;
    });
    for (std::size_t k = 0; k < diagonal.size(); ++k)
      if (is_coupled[k]) entries.emplace_back(static_cast<int>(k), static_cast<int>(k), diagonal[k]);
    return entries;
  }

  std::vector<RelativeInertia> terms_;
  ComponentCholesky factor_;  // of the degrees of freedom that terms couple
  mutable std::vector<double> work_;
};

Mass Mass::lumped(std::vector<double> diagonal, const std::vector<RelativeInertia>& relative) {
  Relative::add_to_diagonal(relative, diagonal);
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    if (!(diagonal[i] > 0) || !std::isfinite(diagonal[i])) {
      throw std::invalid_argument(fmt::format(
          "the lumped mass of degree of freedom {} of {} is {}, not positive: no material point gives it mass", i,
          diagonal.size(), diagonal[i]));
    }
  }
  Mass mass;
  mass.size_ = diagonal.size();
  mass.diagonal_ = std::move(diagonal);
  if (!relative.empty()) mass.relative_ = std::make_shared<const Relative>(relative, mass.diagonal_);
  return mass;
}

struct Mass::Consistent {
  explicit Consistent(const SparseMatrix& M) : matrix(M), factor(matrix) {}

  SparseMatrix matrix;
  SparseCholesky factor;
};

Mass Mass::consistent(const SparseMatrix& matrix) {
  Mass mass;
  mass.size_ = static_cast<std::size_t>(matrix.rows());
  mass.diagonal_.resize(mass.size_);
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

Mass Mass::by_inverse(std::size_t n, std::function<void(ConstVec b, Vec x)> solve) {
  if (!solve) throw std::invalid_argument("a mass by its inverse needs one");
  Mass mass;
  mass.size_ = n;
  mass.inverse_ = std::move(solve);
  return mass;
}

void Mass::require_product() const {
  if (!has_product()) throw std::logic_error("this mass is known by its inverse: there is no product with it");
}

SparseMatrix Mass::matrix() const {
  require_product();
  if (!is_lumped()) return consistent_->matrix;
  SparseMatrix diagonal_matrix(index(size()), index(size()));
  diagonal_matrix.setIdentity();
  std::copy(diagonal_.begin(), diagonal_.end(), diagonal_matrix.valuePtr());
  if (relative_)
    relative_->for_each_off_diagonal([&](int i, int j, double value) { diagonal_matrix.coeffRef(i, j) += value; });
  diagonal_matrix.makeCompressed();
  return diagonal_matrix;
}

void Mass::apply(ConstVec x, Vec y) const {
  require_product();
  if (is_lumped()) {
    for_each_index(size(), [=, m = diagonal_.data()](std::size_t i) { y[i] = m[i] * x[i]; });
    if (relative_) relative_->add_off_diagonal(x, y);
  } else {  // M = Mᵀ: by rows, y_i = Σ_j M_ij x_j, which writes each y_i once
    Map(y.data(), index(y.size())).noalias() = consistent_->matrix.transpose() * ConstMap(x.data(), index(x.size()));
  }
}

void Mass::solve(ConstVec b, Vec x) const {
  if (inverse_) {
    inverse_(b, x);
  } else if (is_lumped()) {
    if (relative_) relative_->take(b);  // before x is written, which may be b
    for_each_index(size(), [=, m = diagonal_.data()](std::size_t i) { x[i] = b[i] / m[i]; });
    if (relative_) relative_->solve(x);
  } else {
    consistent_->factor.solve(b, x);
  }
}

void Mass::decouple(Vec b) const {
  if (!is_lumped()) throw std::logic_error("only a lumped mass can be decoupled");
  if (relative_) relative_->decouple(b, diagonal_);
}

double Mass::relative_energy(ConstVec v) const { return relative_ ? relative_->energy(v) : 0; }

}  // namespace stillpoint

// A factor of a stiffness that may have a null space: an hourglass mode of cells with too few points, or a motion of a
// body that nothing holds.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <optional>

#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {

/// Solves K x = b for a symmetric K with no eigenvalue below 0 except by rounding. Rounding gives a singular K
/// meaningless pivots, which amplify the rounding of b: then x is found by conjugate gradients on K, preconditioned by
/// a factor of
///
///   K + σ M,   σ = 1e-9 max |K_ij|/√(M_ii M_jj),
///
/// which takes a few steps whatever K is. From b ⟂ null(K) it leads to the x that is M-orthogonal to null(K), as do
/// conjugate gradients preconditioned by M and a relaxation from rest.
class SemidefiniteFactor {
 public:
  /// K and M have to outlive it. At most three factors are made, one if K is regular.
  SemidefiniteFactor(const SparseMatrix& K, const Mass& M);

  /// Whether K has no negative eigenvalue except by rounding.
  bool semidefinite() const { return semidefinite_; }
  bool regular() const { return semidefinite_ && !shifted_; }
  /// Solves K x = b; b, x: (n). False if K is singular and b drives a motion that it does not resist. Needs
  /// semidefinite().
  bool solve(ConstVec b, Vec x) const;
  std::size_t bytes() const { return shifted_ ? shifted_->bytes() : factor_->bytes(); }

 private:
  const SparseMatrix& K_;
  std::optional<SparseCholesky> factor_, shifted_;
  bool semidefinite_ = false;
};

/// Solves K x = b by GMRES for an unsymmetric K with such a null space, which is one of Kᵀ too. False if it does not
/// converge.
bool solve_unsymmetric_singular(const SparseMatrix& K, const Mass& M, ConstVec b, Vec x);

/// The pivot ratio below which the smallest pivot may be rounding.
constexpr double suspicious_pivot_ratio = 1e-10;

}  // namespace stillpoint

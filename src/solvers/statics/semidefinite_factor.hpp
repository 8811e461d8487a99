// A factor of a stiffness that may have a null space: an hourglass motion of cells with too few points, or the motion
// of a body that nothing holds.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <optional>

#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {

/// K x = b for a symmetric K with no eigenvalue below 0 but for rounding. Rounding gives a singular K pivots that mean
/// nothing, and whatever they make of b's own rounding: there x is found by conjugate gradients on K, preconditioned by
/// a factor of
///
///   K + σ M,   σ = 1e-9 max |K_ij|/√(M_ii M_jj),
///
/// which takes a few steps whatever K is, and from b ⟂ null(K) leads to the x that is M-orthogonal to null(K), the one
/// that conjugate gradients preconditioned by M and a relaxation from rest find as well.
class SemidefiniteFactor {
 public:
  /// K and M outlive it. At most four factors are made, one if K is regular.
  SemidefiniteFactor(const SparseMatrix& K, const Mass& M);

  /// Whether K has no negative eigenvalue but for rounding.
  bool semidefinite() const { return semidefinite_; }
  bool regular() const { return semidefinite_ && !shifted_; }
  /// b, x: (n). False if K is singular and b drives what it does not resist. Needs semidefinite().
  bool solve(ConstVec b, Vec x) const;
  std::size_t bytes() const { return shifted_ ? shifted_->bytes() : factor_->bytes(); }

 private:
  const SparseMatrix& K_;
  std::optional<SparseCholesky> factor_, shifted_;
  bool semidefinite_ = false;
};

/// The same for an unsymmetric K with such a null space, which is one of Kᵀ too: by GMRES. False if it comes to
/// nothing.
bool solve_unsymmetric_singular(const SparseMatrix& K, const Mass& M, ConstVec b, Vec x);

/// Pivots as far apart as this may be rounding.
constexpr double suspicious_pivot_ratio = 1e-10;

}  // namespace stillpoint

// The tangent K with its Cholesky factor, or the reason why it has none: both methods for ω₁ need it.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <string>

#include <Eigen/SparseCore>

#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {

/// A symmetric K with its factor; M and K have to outlive it. Throws std::runtime_error if there is no memory for it.
class FactorisedStiffness {
 public:
  FactorisedStiffness(const Mass& mass, const SparseMatrix& K);

  /// Whether there is a factor for solve().
  bool usable() const { return mass_.size() > 0 && factor_.positive_definite(); }
  /// x = K⁻¹ b; b, x: (n). Needs usable().
  void solve(ConstVec b, Vec x) const { factor_.solve(b, x); }
  /// Why K gives no ω₁: no degrees of freedom, not finite, indefinite, or singular; empty if it gives one.
  /// omega_squared: the ω₁² that was found, 0 if K has no factor.
  std::string refusal(double omega_squared) const;

 private:
  const Mass& mass_;
  const SparseMatrix& K_;
  SparseCholesky factor_;
  double scale_;  // max K_ii/M_ii, at most ω_max² and of its size
};

}  // namespace stillpoint

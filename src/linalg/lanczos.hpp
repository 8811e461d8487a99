// Lanczos' method for the largest eigenvalue of A x = λ B x [Parlett, The Symmetric Eigenvalue Problem, 1980, ch. 13]:
//
//   β_j w_{j+1} = A q_j − α_j w_j − β_{j−1} w_{j−1},   q = B⁻¹w,   α_j = q_jᵀA q_j,   qᵀw = 1
//
// which never multiplies by B. The largest eigenvalue θ of the tridiagonal matrix T of the α and β approaches from
// below; some λ lies within r = β_m |s_m| of it, s_m the last entry of its eigenvector s of T, and within r²/gap, with
// the gap to the next eigenvalue. Q s is the corresponding vector. The method keeps the polynomial that power iteration
// throws away, and needs the square root of its number of applications.
//   ω_max²: A = K, B = M      1/ω₁²: A = M, B = K
#pragma once

#include <stillpoint/vector.hpp>

#include <vector>

#include "linalg/linear_map.hpp"

namespace stillpoint {

class Lanczos {
 public:
  struct Largest {       // or smallest eigenvalue
    double theta = 0;    // from below; the smallest from above
    double missing = 0;  // r
    double error = 0;    // estimate of the error of λ: min(r, r²/gap)
  };

  /// A, B symmetric, B positive definite. The start is B⁻¹b, b: (n). keeps_vectors: whether all q are kept for
  /// vector().
  Lanczos(LinearMap apply_A, LinearMap solve_B, Vector b, bool keeps_vectors = false);

  /// Applies B⁻¹A once more. False if that gives nothing new: the space of the start is exhausted, or a value is not
  /// finite.
  bool step();
  bool finite() const { return finite_; }
  int applications() const { return static_cast<int>(alpha_.size()); }
  /// The largest and the smallest eigenvalue; both need a step() before.
  Largest largest() const;
  Largest smallest() const;
  /// √(rᵀB⁻¹r)/√(bᵀB⁻¹b) = Π β_j/d_j with the pivots d of T: the residual that conjugate gradients on A x = b, with the
  /// preconditioner B⁻¹, would have after as many applications. A mode that b drives and that no Ritz value shows yet
  /// is in r. Infinity if T is not positive definite. Needs a step() before.
  double residual() const;
  /// Q s of the largest eigenvalue, (n). Needs keeps_vectors.
  std::vector<double> vector() const;

 private:
  void divide(double norm);

  LinearMap apply_A_, solve_B_;
  Vector w_, last_w_, q_, Aq_;
  bool keeps_vectors_, finite_ = true, exhausted_ = false;
  std::vector<double> alpha_, beta_;
  std::vector<std::vector<double>> all_;  // q, if kept
  double bound_ = 0;                      // bound of the eigenvalues of T
};

}  // namespace stillpoint

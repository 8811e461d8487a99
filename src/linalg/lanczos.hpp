// Lanczos' method for the largest eigenvalue of A x = λ B x [Parlett, The Symmetric Eigenvalue Problem, 1980, ch. 13]:
//
//   β_j w_{j+1} = A q_j − α_j w_j − β_{j−1} w_{j−1},   q = B⁻¹w,   α_j = q_jᵀA q_j,   qᵀw = 1
//
// which never multiplies by B.
// The largest eigenvalue θ of the tridiagonal matrix T of the α and β is from below; some λ lies within r = β_m |s_m|
// of it, s_m the last entry of its eigenvector s of T, and within r²/gap, the gap to the next one. Q s is its vector.
// It keeps the polynomial that power iteration throws away, and takes the square root of its applications.
//   ω_max²: A = K, B = M      1/ω₁²: A = M, B = K
#pragma once

#include <stillpoint/vector.hpp>

#include <vector>

#include "linalg/linear_map.hpp"

namespace stillpoint {

class Lanczos {
 public:
  struct Largest {       // or smallest
    double theta = 0;    // from below; the smallest from above
    double missing = 0;  // r
    double error = 0;    // what of λ is missing, estimated: min(r, r²/gap)
  };

  /// A, B symmetric, B positive definite. The start is B⁻¹b, b: (n). keeps_vectors: all q, for vector().
  Lanczos(LinearMap apply_A, LinearMap solve_B, Vector b, bool keeps_vectors = false);

  /// One application more of B⁻¹A. False if there was nothing to find out: the start lies in what has been seen, or a
  /// value is not finite.
  bool step();
  bool finite() const { return finite_; }
  int applications() const { return static_cast<int>(alpha_.size()); }
  /// After a step().
  Largest largest() const;
  Largest smallest() const;
  /// After a step(): what conjugate gradients on A x = b, with B⁻¹ for a preconditioner, would have left of b after as
  /// many applications, √(rᵀB⁻¹r)/√(bᵀB⁻¹b) = Π β_j/d_j with the pivots d of T. A mode that b drives and that no Ritz
  /// value shows yet is in r. Infinity where T is not positive definite.
  double residual() const;
  /// Q s of the largest, (n). Needs keeps_vectors.
  std::vector<double> vector() const;

 private:
  void divide(double norm);

  LinearMap apply_A_, solve_B_;
  Vector w_, last_w_, q_, Aq_;
  bool keeps_vectors_, finite_ = true, exhausted_ = false;
  std::vector<double> alpha_, beta_;
  std::vector<std::vector<double>> all_;  // q, if kept
  double bound_ = 0;                      // of the eigenvalues of T
};

}  // namespace stillpoint

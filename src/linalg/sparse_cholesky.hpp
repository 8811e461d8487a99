// A sparse Cholesky factor that solves repeatedly without allocating.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string_view>

namespace stillpoint {

/// The factor A = L Lᵀ of a symmetric positive definite A (n × n).
class SparseCholesky {
 public:
  /// Factorises A. Throws std::runtime_error if the library itself fails (memory);
  /// a matrix that is not positive definite is no error: see positive_definite().
  explicit SparseCholesky(const SparseMatrix& A);
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  ~SparseCholesky();

  /// Whether the factorisation succeeded, which proves (up to rounding) that A is positive definite.
  bool positive_definite() const;
  /// The ratio of the smallest to the largest pivot, (min L_kk/max L_kk)², an upper bound of 1/κ(A): if it is of the
  /// size of rounding, A may be singular. 1 if n = 0; needs positive_definite().
  double pivot_ratio() const;
  /// x = A⁻¹ b; b, x: (n), may be the same array. Allocates nothing after the first call. Needs positive_definite().
  void solve(ConstVec b, Vec x) const;
  std::size_t size() const;
  /// The memory of the factor and its work space [bytes].
  std::size_t bytes() const;

  /// The name of the library that makes the factor.
  static std::string_view library();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stillpoint

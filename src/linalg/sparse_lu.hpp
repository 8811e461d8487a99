// A sparse LU factor that solves repeatedly without allocating.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string_view>

namespace stillpoint {

/// The factors P R A Q = L U of a square A (n × n): P, Q permutations, R a scaling of the rows.
class SparseLu {
 public:
  /// Factorises A, of which it keeps a copy. Throws std::runtime_error if the library itself fails (memory); a matrix
  /// that is singular or not finite is no error: see regular().
  explicit SparseLu(const SparseMatrix& A);
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;
  ~SparseLu();

  /// Whether every pivot is finite and not zero: min |U_ii|/max |U_ii| > 0.
  bool regular() const;
  /// The ratio of the smallest to the largest pivot: if it is of the size of rounding, A may be singular. 1 if n = 0;
  /// needs regular().
  double pivot_ratio() const;
  /// x = A⁻¹ b with up to two steps of iterative refinement; b, x: (n), may be the same array. Allocates nothing.
  /// Needs regular().
  void solve(ConstVec b, Vec x) const;
  std::size_t size() const;
  /// The memory of the factor, the copy of A and the work space [bytes].
  std::size_t bytes() const;

  /// The name of the library that makes the factor.
  static std::string_view library();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stillpoint

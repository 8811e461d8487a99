// The factor inside SparseCholesky: by CHOLMOD, or by Eigen in a build without the libraries under the GPL.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string_view>

namespace stillpoint {

/// A factor of a matrix A with at least one row. The object never moves in memory.
class CholeskyFactor {
 public:
  CholeskyFactor() = default;
  CholeskyFactor(const CholeskyFactor&) = delete;
  CholeskyFactor& operator=(const CholeskyFactor&) = delete;
  virtual ~CholeskyFactor() = default;

  /// Factorises A, which has to be compressed. True if it is positive definite, so that solve() may be called. Throws
  /// std::runtime_error if no memory is left.
  virtual bool factorise(const SparseMatrix& A) = 0;
  /// (min L_kk/max L_kk)²; only after factorise() returned true.
  virtual double pivot_ratio() const = 0;
  /// Solves as SparseCholesky::solve() does; the first call may allocate.
  virtual void solve(ConstVec b, Vec x) = 0;
  virtual std::size_t bytes() const = 0;
};

std::shared_ptr<CholeskyFactor> make_cholesky_factor();

std::string_view cholesky_library();

}  // namespace stillpoint

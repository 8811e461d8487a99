// What SparseCholesky keeps: a factor by CHOLMOD, or by Eigen in a build without the libraries under the GPL.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string_view>

namespace stillpoint {

/// Of an A that has one row or more. Its address never changes.
class CholeskyFactor {
 public:
  CholeskyFactor() = default;
  CholeskyFactor(const CholeskyFactor&) = delete;
  CholeskyFactor& operator=(const CholeskyFactor&) = delete;
  virtual ~CholeskyFactor() = default;

  /// A: compressed. True: it is positive definite, and the factor solves. Throws std::runtime_error if no memory is
  /// left.
  virtual bool factorise(const SparseMatrix& A) = 0;
  /// (min L_kk/max L_kk)²; of one that solves.
  virtual double pivot_ratio() const = 0;
  /// As SparseCholesky's; the first call may allocate.
  virtual void solve(ConstVec b, Vec x) = 0;
  virtual std::size_t bytes() const = 0;
};

std::shared_ptr<CholeskyFactor> make_cholesky_factor();

std::string_view cholesky_library();

}  // namespace stillpoint

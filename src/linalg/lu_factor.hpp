// The factor inside SparseLu: by UMFPACK, or by Eigen in a build without the libraries under the GPL.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string_view>

namespace stillpoint {

/// A factor of a matrix A with at least one entry. The object never moves in memory.
class LuFactor {
 public:
  LuFactor() = default;
  LuFactor(const LuFactor&) = delete;
  LuFactor& operator=(const LuFactor&) = delete;
  virtual ~LuFactor() = default;

  /// Factorises A. True if it is regular, so that solve() may be called. Throws std::runtime_error if no memory is
  /// left.
  virtual bool factorise() = 0;
  /// min |U_kk|/max |U_kk|; only after factorise() returned true.
  virtual double pivot_ratio() const = 0;
  /// Solves as SparseLu::solve() does.
  virtual void solve(ConstVec b, Vec x) = 0;
  /// The memory of the factor and of its copy of A [bytes].
  virtual std::size_t bytes() const = 0;
};

/// A factor object that keeps a copy of A.
std::shared_ptr<LuFactor> make_lu_factor(const SparseMatrix& A);

std::string_view lu_library();

}  // namespace stillpoint

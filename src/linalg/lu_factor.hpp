// What SparseLu keeps: a factor by UMFPACK, or by Eigen in a build without the libraries under the GPL.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string_view>

namespace stillpoint {

/// Of an A that has one entry or more. Its address never changes.
class LuFactor {
 public:
  LuFactor() = default;
  LuFactor(const LuFactor&) = delete;
  LuFactor& operator=(const LuFactor&) = delete;
  virtual ~LuFactor() = default;

  /// True: A is regular, and the factor solves. Throws std::runtime_error if no memory is left.
  virtual bool factorise() = 0;
  /// min |U_kk|/max |U_kk|; of one that solves.
  virtual double pivot_ratio() const = 0;
  /// As SparseLu's.
  virtual void solve(ConstVec b, Vec x) = 0;
  /// With its copy of A.
  virtual std::size_t bytes() const = 0;
};

/// Keeps a copy of A.
std::shared_ptr<LuFactor> make_lu_factor(const SparseMatrix& A);

std::string_view lu_library();

}  // namespace stillpoint

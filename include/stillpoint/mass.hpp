// The mass matrix M of a Lagrangian phase: a diagonal, or a sparse matrix with its factor.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace stillpoint {

/// M (n × n), symmetric positive definite, constant for a phase. Units: kg.
class Mass {
 public:
  /// A diagonal M. Throws std::invalid_argument if an entry is not positive.
  static Mass lumped(std::vector<double> diagonal);
  /// M_ij = Σ_p m_p N_ip N_jp, factorised once. Throws std::invalid_argument if M is not positive definite.
  static Mass consistent(const SparseMatrix& matrix);

  std::size_t size() const { return diagonal_.size(); }
  bool is_lumped() const { return !consistent_; }
  /// The diagonal of M, (n).
  ConstVec diagonal() const { return diagonal_; }
  /// M as a sparse matrix, for assembly and shift-invert.
  SparseMatrix matrix() const;
  /// y = M x; x, y: (n), distinct.
  void apply(ConstVec x, Vec y) const;
  /// x = M⁻¹ b; b, x: (n), may be the same array. Allocates nothing.
  void solve(ConstVec b, Vec x) const;

 private:
  struct Consistent;

  std::vector<double> diagonal_;
  std::shared_ptr<const Consistent> consistent_;  // the matrix and its factor; null if lumped
};

}  // namespace stillpoint

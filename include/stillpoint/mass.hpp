// The mass matrix M of a Lagrangian phase: a diagonal, with inertia against relative motion if nodes are light, or a
// sparse matrix with its factor.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace stillpoint {

/// Inertia against relative motion alone: the kinetic energy ½ inertia (v_dof − Σ_k weight_k v_master_k)². It leaves
/// alone what the weights extrapolate exactly, a rigid motion, say [selective mass scaling, Olovsson et al. 2005].
struct RelativeInertia {
  int dof = 0;
  double inertia = 0;  // [kg]
  int masters = 0;     // 0: against any motion
  std::array<int, 4> master{};
  std::array<double, 4> weight{};
};

/// M (n × n), symmetric positive definite, constant for a phase. Units: kg.
class Mass {
 public:
  /// M = diag m + Σ inertia q qᵀ, q = e_dof − Σ_k weight_k e_master_k. Throws std::invalid_argument if a diagonal entry
  /// of M is not positive.
  static Mass lumped(std::vector<double> m, const std::vector<RelativeInertia>& relative = {});
  /// M_ij = Σ_p m_p N_ip N_jp, factorised once. Throws std::invalid_argument if M is not positive definite.
  static Mass consistent(const SparseMatrix& matrix);

  std::size_t size() const { return diagonal_.size(); }
  bool is_lumped() const { return !consistent_; }
  bool is_diagonal() const { return is_lumped() && !relative_; }
  /// The diagonal of M, (n).
  ConstVec diagonal() const { return diagonal_; }
  /// M as a sparse matrix, for assembly and shift-invert.
  SparseMatrix matrix() const;
  /// y = M x; x, y: (n), distinct.
  void apply(ConstVec x, Vec y) const;
  /// x = M⁻¹ b; b, x: (n), may be the same array. Allocates nothing.
  void solve(ConstVec b, Vec x) const;
  /// b = D M⁻¹ b, D = diag M, of a lumped mass: from then on M⁻¹b is b_i/D_ii at every degree of freedom; b: (n).
  /// Allocates nothing.
  void decouple(Vec b) const;
  /// What of ½ vᵀMv is of the relative inertia, [J]; v: (n).
  double relative_energy(ConstVec v) const;

 private:
  struct Consistent;
  class Relative;

  std::vector<double> diagonal_;
  std::shared_ptr<const Relative> relative_;      // null if there is none
  std::shared_ptr<const Consistent> consistent_;  // the matrix and its factor; null if lumped
};

}  // namespace stillpoint

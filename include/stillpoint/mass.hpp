// The mass matrix M of a Lagrangian phase: a diagonal, with inertia against relative motion where nodes are light, or a
// sparse matrix with its factor. On the way to rest inertia is fictitious, so M may also be known by its inverse alone.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace stillpoint {

/// Inertia against relative motion alone: the kinetic energy ½ inertia (v_dof − Σ_k weight_k v_master_k)². Motions that
/// the weights extrapolate exactly, such as a rigid motion, are unaffected [selective mass scaling, Olovsson et al.
/// 2005].
struct RelativeInertia {
  int dof = 0;
  double inertia = 0;  // [kg]
  int masters = 0;     // number of masters; 0: inertia against any motion
  std::array<int, 8> master{};
  std::array<double, 8> weight{};
};

/// M (n × n), symmetric positive definite, constant for a phase. Units: kg.
class Mass {
 public:
  /// M = diag m + Σ inertia q qᵀ, q = e_dof − Σ_k weight_k e_master_k. Throws std::invalid_argument if a diagonal entry
  /// of M is not positive.
  static Mass lumped(std::vector<double> m, const std::vector<RelativeInertia>& relative = {});
  /// M_ij = Σ_p m_p N_ip N_jp, factorised once. Throws std::invalid_argument if M is not positive definite.
  static Mass consistent(const SparseMatrix& matrix);

  /// M given by its inverse: solve(b, x), x = M⁻¹ b, symmetric and positive definite; b, x: (n), may be the same array.
  static Mass by_inverse(std::size_t n, std::function<void(ConstVec b, Vec x)> solve);

  std::size_t size() const { return size_; }
  bool is_lumped() const { return !consistent_ && !inverse_; }
  /// Whether M can be multiplied by, so that v is as good an unknown as the momentum p = M v; if not, solve() is the
  /// only one of the functions below that may be called.
  bool has_product() const { return !inverse_; }
  bool is_diagonal() const { return is_lumped() && !relative_; }
  /// The diagonal of M, (n); empty if M is known by its inverse.
  ConstVec diagonal() const { return diagonal_; }
  /// M as a sparse matrix, for assembly and shift-invert.
  SparseMatrix matrix() const;
  /// y = M x; x, y: (n), distinct.
  void apply(ConstVec x, Vec y) const;
  /// x = M⁻¹ b; b, x: (n), may be the same array. Allocates nothing.
  void solve(ConstVec b, Vec x) const;
  /// b = D M⁻¹ b, D = diag M, for a lumped mass: afterwards M⁻¹b is b_i/D_ii at every degree of freedom; b: (n).
  /// Allocates nothing.
  void decouple(Vec b) const;
  /// The share of ½ vᵀMv that is due to the relative inertia, [J]; v: (n).
  double relative_energy(ConstVec v) const;

 private:
  struct Consistent;
  class Relative;

  void require_product() const;

  std::size_t size_ = 0;
  std::vector<double> diagonal_;
  std::function<void(ConstVec, Vec)> inverse_;    // empty unless M is known by its inverse
  std::shared_ptr<const Relative> relative_;      // null if there is none
  std::shared_ptr<const Consistent> consistent_;  // the matrix and its factor; null if lumped
};

}  // namespace stillpoint

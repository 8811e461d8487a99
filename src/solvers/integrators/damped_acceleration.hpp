// The acceleration under C = c_m M + c_i I, as the one-force schemes treat it:
//
//   lagged    M a = Q − C v                            averaged  M a = Q − C (v + h/2 a)
//   implicit  M a = Q − C (v + h a)                    exact     v + h a = the solution at h of v' = M⁻¹(Q − C v), Q
//   frozen
//
// With a diagonal M each degree of freedom has its own rate r = c_m + c_i/m, and all four are
//   a = g(h r) (Q/m − r v),   g(z) = 1,  1/(1 + z/2),  1/(1 + z),  (1 − e^{−z})/z.
#pragma once

#include <stillpoint/integrator.hpp>
#include <stillpoint/mass.hpp>

#include <optional>
#include <vector>

#include "base/parallel_loop.hpp"
#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {

/// The factor g(z) above.
double damping_factor(DampingTreatment treatment, double z);

/// The amplification of  v⁺ = v⁻ + h a(v⁻, Q_n),  u⁺ = u + h v⁺,  which is both leapfrog and symplectic Euler.
AmplificationRadius kick_drift_amplification(DampingTreatment treatment);

class DampedAcceleration {
 public:
  /// Throws std::invalid_argument for the exact treatment if C and M are not both diagonal. The mass belongs to the
  /// system and has to outlive this object.
  DampedAcceleration(DampingTreatment treatment, const LinearDamping& C, const Mass& mass);

  /// Replaces Q by a, one piece of the degrees of freedom at a time, and then calls use(begin, count) for each piece.
  /// h [s]; v, Q_to_a: (n). Allocates only if M + θ h C has to be factorised for a new h.
  template <class Use>
  void operator()(double h, ConstVec v, Vec Q_to_a, const Use& use) {
    couple(h, v, Q_to_a);
    for_each_piece(Q_to_a.size(), [&](std::size_t begin, std::size_t count) {
      of_piece(h, begin, v.subspan(begin, count), Q_to_a.subspan(begin, count));
      use(begin, count);
    });
  }
  void operator()(double h, ConstVec v, Vec Q_to_a) {
    (*this)(h, v, Q_to_a, [](std::size_t, std::size_t) {});
  }

 private:
  bool is_coupled() const { return C_.identity != 0 && !mass_.is_diagonal(); }
  void couple(double h, ConstVec v, Vec Q_to_a);
  void of_piece(double h, std::size_t begin, ConstVec v, Vec Q_to_a) const;
  void make_factors(double h);
  void solve_coupled(double h, ConstVec v, Vec Q_to_a);

  DampingTreatment treatment_;
  LinearDamping C_;
  const Mass& mass_;
  double h_ = -1;                         // step for which the next two were made [s]
  std::vector<double> factor_;            // g(h r_i), (n), if c_i ≠ 0 and M is diagonal
  std::optional<SparseCholesky> matrix_;  // M + θ h C, if c_i ≠ 0 and M is not diagonal
  std::vector<double> Mv_;
};

}  // namespace stillpoint

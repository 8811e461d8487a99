// The out-of-balance force of a static problem, and its size relative to the loads.
#pragma once

#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/vector.hpp>

#include <algorithm>
#include <stdexcept>

#include "base/parallel_loop.hpp"
#include "linalg/vector_operations.hpp"
#include "system/force_scale.hpp"

namespace stillpoint {

/// Whether supports have yet to go their way, which static solvers divide: the body is where the phase began.
inline bool is_undisplaced(ConstVec u) {
  return std::ranges::all_of(u, [](double u_k) { return u_k == 0; });
}

/// Q_s(u) = (1 − s) R₀ + s F(t, u) − R(t, u), s the load factor, R₀ the internal force at the start. Where supports are
/// is a matter of the caller.
class StaticBalance {
 public:
  StaticBalance(const SemiDiscrete& system, double t, const VectorSpace& vectors)
      : Q(vectors.make(system.size())),
        system_(system),
        t_(t),
        trial_(system.make_trial()),
        F_(vectors.make(system.size())),
        R_(vectors.make(system.size())),
        R0_(vectors.make(system.size())) {
    if (system.contact())
      throw std::invalid_argument("a static solution with contact is not written: take relaxation, or supports");
  }

  /// Sets R₀ = R(u). False if u is inadmissible.
  bool start(ConstVec u) {
    if (!evaluate(1, u)) return false;
    copy(R_, R0_);
    return true;
  }
  /// Evaluates Q and residual() at u. False if u is inadmissible.
  bool evaluate(double s, ConstVec u) {
    ++evaluations;
    if (!system_.internal_force(t_, u, R_.span(), *trial_)) return false;
    system_.external_force(t_, u, F_.span());
    for_each_index(Q.size(), [=, Q = Q.span().data(), F = F_.span().data(), R = R_.span().data(),
                              R0 = R0_.span().data()](std::size_t i) { Q[i] = s * F[i] - R[i] + (1 - s) * R0[i]; });
    scale_ = force_scale_.of(norm(F_), R_, *trial_, nullptr);
    return true;
  }
  /// ‖Q‖/‖F‖, or ‖Q‖ relative to the scale that replaces ‖F‖ (ForceScale).
  double residual() const { return relative(norm(Q), scale_); }
  /// The internal force at the last evaluation, (n) [N].
  const Vector& R() const { return R_; }
  /// The history of the points after the last evaluation, not yet committed.
  TrialState& trial() { return *trial_; }

  Vector Q;  // at the last evaluation, (n) [N]
  long evaluations = 0;

 private:
  const SemiDiscrete& system_;
  double t_;
  std::unique_ptr<TrialState> trial_;
  Vector F_, R_, R0_;
  ForceScale force_scale_;
  double scale_ = 0;
};

}  // namespace stillpoint

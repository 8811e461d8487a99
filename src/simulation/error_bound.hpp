// How far from equilibrium a state is at most, from its residual and the lowest frequency.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <limits>
#include <optional>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// ‖u − u*‖_M ≤ ‖M⁻¹(F − R)‖_M/ω₁², relative to ‖u‖_M. A bound if K is constant, with the ω₁ of the beginning; if
/// it is not, an estimate with the ω₁ of the tangent where refresh() last looked.
class ErrorBound {
 public:
  /// omega_1: of the beginning; empty if there is none, and then there is no distance.
  ErrorBound(const LagrangianPhase& phase, std::optional<double> omega_1);

  std::optional<double> distance(RelaxationSystem& relaxation, const Vector& u);
  /// The last one beside the largest ‖u‖_M so far instead, which a body that is unloaded to nothing leaves behind.
  std::optional<double> beside_largest() const { return beside_largest_; }
  /// Looks at the tangent at (t, u), if that may have changed since it last did with a larger residual. Where the
  /// tangent is not positive definite there is no distance any more. False if nothing was done.
  bool refresh(double t, ConstVec u, double residual);

  void archive(const StateArchive& state) {
    state("omega_1", omega_1_);
    state("beside_largest", beside_largest_);
    state("largest", largest_);
    state("refreshed_at", refreshed_at_);
  }

 private:
  const LagrangianPhase& phase_;
  std::optional<double> omega_1_, beside_largest_;
  double largest_ = 0;                                             // ‖u‖_M so far
  double refreshed_at_ = std::numeric_limits<double>::infinity();  // the residual then
};

}  // namespace stillpoint

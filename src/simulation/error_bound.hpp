// How far from equilibrium a state is at most, from its residual and the lowest frequency.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <algorithm>
#include <limits>
#include <optional>

#include "simulation/setup/volume_norm.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// ‖u − u*‖_V ≤ ‖u − u*‖_K/ω_V,  ‖u − u*‖_K ≤ ‖M⁻¹Q‖_M/ω₁ and ≤ ‖V⁻¹Q‖_V/ω_V, Q = F − R, relative to ‖u‖_V, with the
/// lowest frequencies ω₁ and ω_V of K beside M and V; V = M if the M-norm is as good; V = K, ω_V = 1, if M is known by
/// its inverse, as no product with it is then needed. A bound if K is constant, with
/// the frequencies of the beginning; if it is not, an estimate with those of the tangent where refresh() last looked.
class ErrorBound {
 public:
  /// omega_1: of the beginning; empty if there is none, and then there is no distance. volume: empty if V = M.
  ErrorBound(const LagrangianPhase& phase, std::optional<double> omega_1, std::optional<VolumeNorm> volume);

  /// ω₁, where none was known at the beginning and V = M: the lowest so far.
  void learn(double omega_1) { omega_1_ = std::min(omega_1, omega_1_.value_or(omega_1)); }
  /// After an evaluation at u, (n). acceleration: M⁻¹Q there, if it is known; else empty.
  std::optional<double> distance(RelaxationSystem& relaxation, const Vector& u, ConstVec acceleration = {});
  /// The last one beside the largest ‖u‖_V so far instead, if that is a hundred times as large: unloaded to nothing.
  std::optional<double> beside_largest() const { return beside_largest_; }
  /// Nothing acts on the body from now on but what does now: a linear one, which cannot get any energy beyond what it
  /// then has, is no measure for itself where it still comes to be larger, as with a step that is not stable. After
  /// distance(); the first call counts.
  void loads_have_settled(double kinetic_energy);
  /// Looks at the tangent at (t, u), if that may have changed since it last did with a larger residual. Where the
  /// tangent is not positive definite there is no distance any more. False if nothing was done.
  bool refresh(double t, ConstVec u, double residual);

  void archive(const StateArchive& state) {
    state("omega_1", omega_1_);
    state("beside_largest", beside_largest_);
    state("energy_error", energy_error_);
    state("size", size_);
    state("largest", largest_);
    state("most", most_);
    if (volume_) state("omega_of_volume", volume_->omega_1);
    state("refreshed_at", refreshed_at_);
  }

 private:
  double omega_V() const;
  double strain_norm(const RelaxationSystem& relaxation, const Vector& u) const;

  const LagrangianPhase& phase_;
  std::optional<double> omega_1_, beside_largest_;
  std::optional<VolumeNorm> volume_;
  bool by_strain_ = false;                                         // V = K
  double energy_error_ = 0, size_ = 0;                             // of the last distance()
  double largest_ = 0;                                             // ‖u‖_V so far
  double most_ = std::numeric_limits<double>::infinity();          // that it can become
  double refreshed_at_ = std::numeric_limits<double>::infinity();  // the residual then
};

}  // namespace stillpoint

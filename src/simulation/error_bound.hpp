// A bound on the distance of a state from equilibrium, from its residual and the lowest frequency.
#pragma once

#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <limits>
#include <optional>

#include "simulation/setup/volume_norm.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// ‖u − u*‖_V ≤ ‖u − u*‖_K/ω_V,  ‖u − u*‖_K ≤ ‖M⁻¹Q‖_M/ω₁ and ≤ ‖V⁻¹Q‖_V/ω_V, Q = F − R, relative to ‖u‖_V, with the
/// lowest frequencies ω₁ and ω_V of K beside M and V; V = M if the M-norm is as good; V = K, ω_V = 1, if M is known by
/// its inverse, as no product with it is then needed. It is a bound if K is constant, with the frequencies of the
/// beginning; otherwise it is an estimate with those of the tangent at which refresh() last looked.
class ErrorBound {
 public:
  /// omega_1: the frequency of the beginning; if it is empty there is no distance. volume: empty if V = M.
  ErrorBound(const LagrangianPhase& phase, std::optional<double> omega_1, std::optional<VolumeNorm> volume);

  /// Takes an ω₁ that shows on the way, if none was known at the beginning and V = M; the lowest so far counts.
  void learn(double omega_1) { omega_1_ = std::min(omega_1, omega_1_.value_or(omega_1)); }
  /// The distance of u, (n), where the system was evaluated last. acceleration: its M⁻¹Q; empty: it is not known.
  std::optional<double> distance(StateNorms& norms, const Vector& u, ConstVec acceleration = {});
  /// The last distance, but relative to the largest ‖u‖_V so far if that is a hundred times as large: after unloading.
  std::optional<double> beside_largest() const { return beside_largest_; }
  /// From now on the loads stay what they are, so that a linear body gets no energy beyond what it has: if ‖u‖_V still
  /// becomes larger than that allows, as with a step that is not stable, it is no measure. To be called after
  /// distance(); the first call counts.
  void loads_have_settled(double kinetic_energy);
  /// Looks at the tangent at (t, u), if that may have changed since it last did with a larger residual. If the tangent
  /// is not positive definite there is no distance any more. False if nothing was done.
  bool refresh(double t, ConstVec u, double residual);

  void archive(const StateArchive& state) {
    state("omega_1", omega_1_);
    state("beside_largest", beside_largest_, "energy_error", energy_error_, "size", size_, "largest", largest_, "most",
          most_);
    if (volume_) state("omega_of_volume", volume_->omega_1);
    state("refreshed_at", refreshed_at_);
  }

 private:
  double omega_V() const;
  double strain_norm(const Evaluation& last, const Vector& u) const;
  double rounding_norm(StateNorms& norms, const Mass& V, std::size_t unknowns);

  const LagrangianPhase& phase_;
  std::optional<double> omega_1_, beside_largest_;
  std::optional<VolumeNorm> volume_;
  std::optional<double> rounding_norm_;
  bool by_strain_ = false;                                 // whether V = K
  double energy_error_ = 0, size_ = 0;                     // ‖u − u*‖_K at most, and ‖u‖_V, of the last u
  double largest_ = 0;                                     // ‖u‖_V so far
  double most_ = std::numeric_limits<double>::infinity();  // ‖u‖_V at most, once loads have settled
  double refreshed_at_ = std::numeric_limits<double>::infinity();  // the residual at the last refresh()
};

}  // namespace stillpoint

// Norms and energies of a state, from what the last evaluation of its system left.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <optional>

namespace stillpoint {

class StateNorms {
 public:
  /// The system has to outlive this object.
  explicit StateNorms(RelaxationSystem& system) : system_(system), Q_(system.vectors().make(system.size())) {}

  RelaxationSystem& system() { return system_; }

  /// The relative residual ‖F − R‖/‖F‖ at (t, u), with contact forces; ‖F‖ is the system's force_scale(). 0 if there is
  /// no load, NaN if u cannot be evaluated. The evaluation is not counted.
  double residual(double t, ConstVec u);
  /// The relative residual of the last evaluation, at no cost.
  double last_residual();
  /// The error bound ‖M⁻¹Q‖_M/ω₁ with Q of the last residual() [√J]: in a linear system it is no less than ‖u − u*‖_K,
  /// since u − u* = −K⁻¹Q and no eigenvalue of M⁻¹K is below ω₁². M: the system's mass, or any other with its own ω₁.
  /// acceleration: M⁻¹Q, (n), if it is known; else empty.
  double energy_error(const Mass& M, double omega_1, ConstVec acceleration = {});
  /// ‖u‖_M [m √kg]; u: (n).
  double mass_norm(const Mass& M, const Vector& u);
  /// |F·u| + |R·u| of the last evaluation [J], the scale of the work done; u: (n).
  double work_scale(const Vector& u) const;
  struct Motion {
    double power;           // Q·v [W]
    double kinetic_energy;  // ½ vᵀ M v [J], without what was added to light nodes
  };
  /// Power and kinetic energy with the Q of the last residual(); v: the second half of y, (n). If that is the momentum
  /// p, takes one product with M⁻¹, or none if the velocity M⁻¹p, (n), is given.
  Motion motion(const Vector& v, ConstVec velocity = {});

 private:
  Vector& work();

  RelaxationSystem& system_;
  Vector Q_;                    // F − R of the last residual(), (n)
  std::optional<Vector> work_;  // (n)
};

}  // namespace stillpoint

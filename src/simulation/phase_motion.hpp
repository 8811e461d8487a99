// The motion through one phase: its unknowns, and what steps them.
#pragma once

#include <stillpoint/state_norms.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "simulation/setup/model.hpp"
#include "simulation/setup/stiffening_step.hpp"
#include "system/force_scale.hpp"

namespace stillpoint {

class PhaseMotion {
 public:
  /// Begins at t with u0 and v0, (n) each. The model outlives it.
  PhaseMotion(Model& model, const Problem& problem, const VectorSpace& vectors, double t, ConstVec u0, ConstVec v0);
  PhaseMotion(const PhaseMotion&) = delete;
  PhaseMotion& operator=(const PhaseMotion&) = delete;

  ConstVec u() const { return first_half(y.span()); }
  /// Velocities, whichever y has; until the next call.
  ConstVec v() const;

  /// Accepts a step to t; a step that has to be stable follows the stiffness.
  void accept(double t);
  /// Saves it, or restores one that begins at the (t, u, v) of then.
  void archive(const StateArchive& state);
  /// Power and kinetic energy of the state that residual() was called for last.
  StateNorms::Motion motion();
  /// Evaluates the system at t, if the last evaluation was elsewhere: in a stage, or in a trial that was refused.
  void evaluate(double t) {
    if (!stepper->known().force) norms.residual(t, u());
  }
  /// ‖F − R‖/‖F‖ at t.
  double residual(double t) { return stepper->known().force ? norms.last_residual() : norms.residual(t, u()); }
  /// The same, at less cost if the stepper knows it; the system is not evaluated then.
  double known_residual(double t) {
    const auto unbalanced = stepper->known().unbalanced_force;
    return unbalanced ? relative(*unbalanced, system.force_scale()) : residual(t);
  }

  RelaxationSystem system;
  StateNorms norms;                  // of the system
  std::shared_ptr<Vector> shared_y;  // shared with whoever looks at it for longer than this object lives
  Vector& y;                         // [u; v], or [u; p] if the system keeps momentum
  Vector u_vector, v_vector;         // its halves, in place
  std::unique_ptr<Stepper> stepper;

 private:
  void follow_stiffness(double t);

  mutable std::vector<double> velocity_;  // M⁻¹p, if it is asked for
  std::optional<StiffeningStep> stiffening_;
};

}  // namespace stillpoint

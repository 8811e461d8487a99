// The motion through one phase: its unknowns, and what integrates them.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include "simulation/model.hpp"
#include "simulation/stiffening_step.hpp"

namespace stillpoint {

class Motion {
 public:
  /// Begins at t with u0 and v0, (n) each. The model outlives it.
  Motion(Model& model, const VectorSpace& vectors, double t, ConstVec u0, ConstVec v0)
      : relaxation(*model.phase, *model.damping, vectors),
        y(vectors.make(2 * model.phase->size())),
        u_vector(vectors.view(first_half(y.span()))),
        v_vector(vectors.view(second_half(y.span()))),
        integrator(make_integrator(model.integrator, relaxation)) {
    std::ranges::copy(u0, first_half(y.span()).begin());
    std::ranges::copy(v0, second_half(y.span()).begin());
    integrator->start(t, y);
    if (model.initial_stiffening) {
      stiffening_.emplace(*model.phase, model.phase->size(), model.integrator.max_step, *model.initial_stiffening);
    }
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  ConstVec u() const { return first_half(y.span()); }
  ConstVec v() const { return second_half(y.span()); }

  /// After an accepted step to t, and where the motion begins: laws remember, contacts open and close, the step follows
  /// the stiffness. Of a static iteration laws remember the end only.
  void accept(double t) {
    if (integrator->static_iteration()) return;
    if (relaxation.accept(t, y.span(), integrator->force_is_current())) integrator->velocity_changed();
    if (stiffening_) integrator->set_max_step(stiffening_->longest(t, u(), v()));
  }
  /// When the phase is over.
  void finish(double t) {
    if (integrator->static_iteration()) relaxation.accept(t, y.span(), true);
  }
  /// ‖F − R‖/‖F‖ at t.
  double residual(double t) {
    return integrator->force_is_current() ? relaxation.last_residual() : relaxation.residual(t, u());
  }

  RelaxationSystem relaxation;
  Vector y;                   // [u; v]
  Vector u_vector, v_vector;  // its halves, in place
  std::unique_ptr<Integrator> integrator;

 private:
  std::optional<StiffeningStep> stiffening_;
};

}  // namespace stillpoint

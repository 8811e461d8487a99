// The base of all marches in time: laws remember every step, and contacts open and close after it.
#pragma once

#include "solvers/integrators/trial_stepper.hpp"

namespace stillpoint {

class March : public TrialStepper {
 public:
  bool moves() const override { return true; }
  void accept(double t) final {
    switch (system().accept(t, state().span(), known().force)) {
      case ContactChange::nothing:
        break;
      case ContactChange::velocity:
        begun(restart(t, state()));
        break;
      case ContactChange::displacement:
        begun(evaluate_anew(t, state()));
    }
  }
  void finish(double /*t*/) final {}
  void take_changed_forces(double t) final { begun(restart(t, state())); }

 protected:
  using TrialStepper::TrialStepper;
  /// Begins again at (t, y) when v has changed, or forces have; the last force evaluation was at this u.
  virtual bool restart(double t, const Vector& y) { return begin(t, y); }
  /// Begins again at (t, y) when u has changed as well, so that there is no force evaluation at it yet.
  virtual bool evaluate_anew(double t, const Vector& y) { return begin(t, y); }
};

}  // namespace stillpoint

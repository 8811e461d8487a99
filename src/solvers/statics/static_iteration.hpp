// What static iterations share: u ← u + α p for a direction p that goes downhill, Q·p > 0, with α by a line search.
//
// There is no time in R(u) = F: a step is a new iterate, v is 0, and the pseudo-time goes by the step given so that
// rows and limits work as for the others. Laws of the material see one increment from where they were last committed to
// the solution, which is committed at the end: the implicit increment of a static step.
#pragma once

#include "solvers/integrators/stepping_integrator.hpp"
#include "solvers/statics/line_search.hpp"

namespace stillpoint {

class StaticIteration : public SteppingIntegrator {
 public:
  bool force_is_current() const final { return true; }
  bool static_iteration() const final { return true; }

 protected:
  /// max_step: below leapfrog's critical step [s]; sigma: of the line search. Throws std::invalid_argument if
  /// something touches the body.
  StaticIteration(double max_step, RelaxationSystem& system, LineSearch::Accuracy sigma);

  /// Forgets earlier steps.
  virtual void forget() = 0;
  /// p from Q() and M⁻¹Q, (n); returns the α to try first.
  virtual double direction(Vec p) = 0;
  /// The step α p was taken: the force is Q(), the one before last_Q().
  virtual void moved(double alpha) = 0;

  /// What the method remembers itself.
  virtual void archive_method(const StateArchive& state) = 0;

  const Vector& Q() const { return Q_; }
  const Vector& z() const { return z_; }            // M⁻¹Q
  const Vector& last_Q() const { return next_Q_; }  // in moved() only
  const Vector& p() const { return p_; }
  /// What α is safe along M⁻¹Q: 1/ω_max², from the step given.
  double shortest() const { return options().max_step * options().max_step / 4; }

 private:
  void begin(double t, const Vector& y) final;
  Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) final;
  void accepted() final;
  void archive_memory(const StateArchive& state) final;
  bool search(double t, Vec u_new);

  LineSearch::Accuracy sigma_;
  Vector Q_, z_, next_Q_, p_;
  double alpha_ = 0;
  bool admissible_ = true, moves_ = false;
};

}  // namespace stillpoint

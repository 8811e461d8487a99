// The base of all steppers around a step that is tried: it divides the interval to t_stop, tries a step, examines the
// trial, and retries or accepts it.
#pragma once

#include <stillpoint/integrator.hpp>

#include <optional>
#include <string>

#include "solvers/integrators/step_division.hpp"

namespace stillpoint {

class TrialStepper : public Stepper {
 public:
  /// An inadmissible trial is tried again with half its step, at most max_halvings times. The first admissible trial
  /// may still be nearly turned inside out, under stresses that would tear it apart within that step: the step finally
  /// taken is shorter than that one by the factor `clearance`.
  static constexpr int max_halvings = 10;
  static constexpr double clearance = 4;

  void start(double t, Vector& y) final;
  StepReport step(double t_stop) final;
  void set_max_step(double h) final;
  void archive(const StateArchive& state) final;

 protected:
  struct Attempt {
    StepReport::Status status = StepReport::Status::ok;
    double h = 0;          // length taken or, if inadmissible, tried [s]; 0: the state at t itself is inadmissible
    double t = 0;          // adaptive steps: the time of the trial [s]
    bool keeps_v = false;  // v stays the one in y; the second half of the trial is ignored
    std::optional<bool> is_finite{};  // whether the trial is finite, if known
    std::string message{};  // why it failed; the caller finds the place of an inadmissible or non-finite state
  };

  TrialStepper(const IntegratorOptions& options, RelaxationSystem& system);

  /// Begins at (t, y). False if the state there cannot be evaluated.
  virtual bool begin(double t, const Vector& y) = 0;
  /// Called when it has begun, or begun again, at the present state. is_admissible: whether that can be evaluated.
  void begun(bool is_admissible) {
    is_admissible_ = is_admissible;
    is_at_state_ = true;
  }
  /// Tries one step from (t, y), which can be evaluated, of length h or, adaptive, at most h and not past t_stop. y,
  /// trial: (2n); y is only read.
  virtual Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) = 0;
  /// Called after the last trial has become the state.
  virtual void accepted() {}
  /// Called after the last trial was rejected although attempt() thought it good.
  virtual void refused() {}
  /// Called after options().max_step has changed.
  virtual void max_step_changed() {}
  /// Archives what the stepper remembers of earlier steps; called after a begin() at the same (t, y).
  virtual void archive_memory(const StateArchive& /*state*/) {}
  void count_rejected(long rejected) { rejected_ += rejected; }

  const IntegratorOptions& options() const { return options_; }
  bool is_admissible() const { return is_admissible_; }
  /// Whether the last trial, if there was one, has become the present state: then a step that ends with the force at
  /// its end knows the force.
  bool is_at_state() const { return is_at_state_; }
  bool adaptive() const { return options_.rtol.has_value(); }

 private:
  bool is_finite(const Attempt& attempt) const;
  StepReport take(const Attempt& attempt);
  std::string message_of(const Attempt& tried, int halvings) const;

  IntegratorOptions options_;
  StepDivision division_;
  std::optional<Vector> trial_;        // (2n), of the same kind as y
  std::optional<Vector> trial_u_, u_;  // views of the first halves of the trial and of y
  double t_ = 0;
  bool is_admissible_ = true, is_at_state_ = false;
};

}  // namespace stillpoint

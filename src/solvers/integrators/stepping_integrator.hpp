// What all integrators do alike around their own step: divide the way to t_stop, try, look at the trial, retry, accept.
#pragma once

#include <stillpoint/integrator.hpp>

#include <optional>
#include <string>

#include "solvers/integrators/step_division.hpp"

namespace stillpoint {

class SteppingIntegrator : public Integrator {
 public:
  /// An inadmissible trial is tried again with half its step, at most so many times. The first that is admissible may
  /// still be as good as turned inside out, under stresses that would tear it apart within that step: the one taken
  /// goes so much less far.
  static constexpr int max_halvings = 10;
  static constexpr double clearance = 4;

  void start(double t, Vector& y) final;
  StepReport step(double t_stop) final;
  void set_max_step(double h) final;
  void velocity_changed() final { restart(t_, *y_); }
  void displacement_changed() final { evaluate_anew(t_, *y_); }
  void archive(const StateArchive& state) final;
  long steps() const final { return steps_; }
  long rejected_steps() const final { return rejected_; }

 protected:
  struct Attempt {
    StepReport::Status status = StepReport::Status::ok;
    double h = 0;          // the length taken or, inadmissible, tried [s]; 0: the state at t itself is inadmissible
    double t = 0;          // adaptive: where the trial is [s]
    bool keeps_v = false;  // v stays what it is in y; what the trial has there does not matter
    std::optional<bool> is_finite{};  // if known: whether the trial is
    std::string message{};  // of what failed; where a state is inadmissible or not finite is found by the caller
  };

  SteppingIntegrator(const IntegratorOptions& options, RelaxationSystem& system);

  /// Begins at (t, y).
  virtual void begin(double t, const Vector& y) = 0;
  /// Begins again at (t, y) if only v has changed; the last force evaluation was there.
  virtual void restart(double t, const Vector& y) { begin(t, y); }
  /// The same if u has changed as well, so that there is no force evaluation yet.
  virtual void evaluate_anew(double t, const Vector& y) { begin(t, y); }
  /// Tries one step from (t, y), of length h or, adaptive, at most h and not past t_stop. y, trial: (2n); y is only
  /// read.
  virtual Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) = 0;
  /// The last trial has become the state.
  virtual void accepted() {}
  /// The last trial, though attempt() thought it good, has not.
  virtual void refused() {}
  /// options().max_step is another one.
  virtual void max_step_changed() {}
  /// What it remembers itself of earlier steps, after a begin() at the same (t, y).
  virtual void archive_memory(const StateArchive& /*state*/) {}
  void count_rejected(long rejected) { rejected_ += rejected; }

  RelaxationSystem& system() { return system_; }
  const IntegratorOptions& options() const { return options_; }
  bool adaptive() const { return options_.rtol.has_value(); }
  /// y, which an integration has begun on, (2n).
  Vector& state() { return *y_; }

 private:
  bool is_finite(const Attempt& attempt) const;
  StepReport accept(const Attempt& attempt);
  std::string message_of(const Attempt& tried, int halvings) const;

  RelaxationSystem& system_;
  IntegratorOptions options_;
  StepDivision division_;
  std::optional<Vector> trial_;  // (2n), of y's kind
  Vector* y_ = nullptr;
  std::optional<Vector> trial_u_, u_;  // their first halves, in place
  double t_ = 0;
  long steps_ = 0, rejected_ = 0;
};

}  // namespace stillpoint

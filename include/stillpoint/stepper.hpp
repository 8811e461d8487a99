// What a simulation steps: a march in time, or a way to equilibrium without time.
#pragma once

#include <stillpoint/state_archive.hpp>
#include <stillpoint/vector.hpp>

#include <optional>
#include <string>
#include <vector>

namespace stillpoint {

class RelaxationSystem;  // <stillpoint/relaxation_system.hpp>

/// The state that an iteration carries over from one phase to the next, whose unknowns are different.
struct CarriedOver {
  double last_step = 0;        // length of the last step; v belongs to half of it ago [s]
  std::optional<double> rate;  // damping c found so far [1/s]
  double step_share = 0;       // share of the given step that the relaxation has reached; 0: it takes its own first one
};

/// The outcome of one call of step().
struct StepReport {
  enum class Status {
    ok,            // an accepted step
    inadmissible,  // the trial state cannot be evaluated (det f ≤ 0 or a non-finite stress), at any step length tried
    not_finite,    // the new state holds inf or NaN
    failed         // the stepper gave up (step underflow, error test failures); see message
  };
  Status status = Status::ok;
  double t = 0;  // where y is now [s]
  double h = 0;  // the step just taken [s]
  std::string message{};
};

/// Advances y in place. One instance steps one y.
class Stepper {
 public:
  /// What the steps have computed of the present (t, y) already; empty: not known. Spans are valid until the next step.
  struct Known {
    bool force = false;  // the system's last force evaluation was there, so that its residual costs nothing
    std::optional<double> unbalanced_force{};  // ‖F − R‖ [N]
    ConstVec velocity{};                       // M⁻¹p of y = [u; p], for a mass known by its inverse: (n) [m/s]
    ConstVec acceleration{};                   // M⁻¹(F − R): (n) [m/s²]
  };
  /// What was done on the body since start() where loads and supports come on in shares s from 0 to 1, not in time.
  struct Way {
    double of_loads = 0;              // ∫ F_s · du [J]
    std::vector<double> reactions{};  // ∫ R_s ds: (supports) [N]; empty: nothing was done yet
  };

  virtual ~Stepper() = default;
  /// Begins at (t, y), y: (2n), which belongs to the caller and must outlive the stepper.
  virtual void start(double t, Vector& y) = 0;
  /// One accepted step, never past t_stop. A fixed step is the largest not above max_step of which a whole number
  /// reaches t_stop, so that equal steps land on every output time. After a failure y holds the last good state.
  virtual StepReport step(double t_stop) = 0;
  /// Called at the present t, at the start and after each step. A march commits it: laws remember, contacts open and
  /// close, and the march goes on from what they change in y. Iterates are not committed.
  virtual void accept(double t) = 0;
  /// Called at the present t if the forces at the present state have changed, as the system's last evaluation, which is
  /// there, has taken over: goes on from it.
  virtual void take_changed_forces(double t) = 0;
  /// Called at the present t, at the end of a phase: commits it, if accept() did not.
  virtual void finish(double t) = 0;
  /// Changes max_step from the next step on, if the critical step changes with the state. h > 0 [s].
  virtual void set_max_step(double h) = 0;
  /// Whether the present state is one of a motion, with a velocity, a kinetic energy and a step that has to be stable.
  /// False: it is an iterate at rest.
  virtual bool moves() const = 0;
  virtual Known known() const { return {}; }
  /// Empty: loads and supports are those of the time.
  virtual std::optional<Way> way() const { return std::nullopt; }
  /// Estimate of the lowest frequency ω₁ [rad/s] among the motions that the loads drive, if the steps so far allow one;
  /// it may take further steps.
  virtual std::optional<double> lowest_frequency() const { return std::nullopt; }
  /// The state that a stepper of the same kind needs to carry on in the next phase.
  virtual CarriedOver carried_over() const { return {}; }
  /// Saves what the next steps depend on beside (t, y) and the system, or restores it after a start() at the saved (t,
  /// y): unless Method::begins_anew, the same steps follow.
  virtual void archive(const StateArchive& state) = 0;

  /// The present damping c [1/s], if the relaxation determines it as it goes.
  std::optional<double> damping_rate() const { return carried_over().rate; }
  long steps() const { return steps_; }              // accepted
  long rejected_steps() const { return rejected_; }  // tried and refused by the error control or as inadmissible

 protected:
  explicit Stepper(RelaxationSystem& system) : system_(system) {}
  RelaxationSystem& system() const { return system_; }
  /// The y on which it has begun, (2n).
  Vector& state() { return *y_; }

  Vector* y_ = nullptr;
  long steps_ = 0, rejected_ = 0;

 private:
  RelaxationSystem& system_;
};

}  // namespace stillpoint

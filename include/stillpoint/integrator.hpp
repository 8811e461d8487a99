// Time integration of y' = f(t, y), y = [u; v], behind one interface.
//
//   leapfrog, symplectic-euler   our own, one force evaluation a step
//   erk:<table>                  SUNDIALS' ARKODE (ERKStep): every packaged explicit table and three of our own
//   gsl:<stepper>                GSL's explicit steppers, an independent second opinion
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/stability.hpp>
#include <stillpoint/state_archive.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct IntegratorOptions {
  std::string method = "leapfrog";
  DampingTreatment treatment = DampingTreatment::automatic;
  /// The largest step [s]: a fixed step's length, an adaptive step's cap (the stability limit times a fraction). > 0.
  double max_step = 0;
  /// Adaptive step if set (erk with an embedding, gsl): local error ≤ rtol |y| + atol.
  std::optional<double> rtol{};
  double atol_u = 1e-12;  // [m]
  double atol_v = 1e-12;  // [m/s]
  /// erk alone: a step ends at each peak of the kinetic energy, and v = 0 there (kinetic damping).
  bool halts_at_energy_peaks = false;
};

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
    failed         // the integrator gave up (step underflow, error test failures); see message
  };
  Status status = Status::ok;
  double t = 0;  // where y is now [s]
  double h = 0;  // the step just taken [s]
  std::string message{};
};

/// Advances y in place. One instance integrates one y.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Begins at (t, y), y: (2n), which belongs to the caller and must outlive the integration.
  virtual void start(double t, Vector& y) = 0;
  /// One accepted step, never past t_stop. A fixed step is the largest not above max_step of which a whole number
  /// reaches t_stop, so that equal steps land on every output time. After a failure y holds the last good state.
  virtual StepReport step(double t_stop) = 0;
  /// Changes max_step from the next step on, if the critical step changes with the state. h > 0 [s].
  virtual void set_max_step(double h) = 0;
  /// Tells the integrator that v in y was changed at the present t, as by a contact that closed; u was not.
  virtual void velocity_changed() = 0;
  /// Tells the integrator that u in y was changed as well, as by a contact that corrected a penetration: the force is
  /// evaluated anew.
  virtual void displacement_changed() = 0;
  /// Whether the system's last force evaluation was at the present (t, y), so that its residual costs nothing.
  virtual bool force_is_current() const { return false; }
  /// ‖F − R‖ at the present (t, y) [N]; empty unless the step computed it.
  virtual std::optional<double> unbalanced_force() const { return std::nullopt; }
  /// M⁻¹p at the present y = [u; p], for a mass known by its inverse: (n) [m/s], valid until the next step; empty
  /// unless the step computed it.
  virtual ConstVec velocity() const { return {}; }
  /// M⁻¹(F − R) at the present (t, y): (n) [m/s²], under the same conditions as velocity().
  virtual ConstVec acceleration() const { return {}; }
  /// Estimate of the lowest frequency ω₁ [rad/s] among the motions that the loads drive, if the steps so far allow one;
  /// it may take further steps.
  virtual std::optional<double> lowest_frequency() const { return std::nullopt; }
  /// The present damping c [1/s], if the relaxation determines it as it goes.
  virtual std::optional<double> damping_rate() const { return std::nullopt; }
  /// The state that an integrator of the same kind needs to carry on in the next phase.
  virtual CarriedOver carried_over() const { return {}; }
  /// Whether steps are iterates of a static solver, so that material laws remember only the last one.
  virtual bool static_iteration() const { return false; }
  /// Saves what the next steps depend on beside (t, y) and the system, or restores it after a start() at the saved (t,
  /// y): unless Method::begins_anew, the same steps follow.
  virtual void archive(const StateArchive& state) = 0;
  virtual long steps() const = 0;           // accepted
  virtual long rejected_steps() const = 0;  // tried and refused by the error control or as inadmissible
};

/// The properties of a method that are known before it runs.
struct Method : MethodInfo {
  int order = 0;                      // order of the fixed-step solution
  int evaluations_per_step = 0;       // right-hand sides that a fixed step costs when implemented right; 0: not fixed
  bool remembers_force = false;       // keeps Q of the last accepted step, as Damping::uses_last_force() needs
  bool hosts_relaxations = false;     // relaxations may take the place of its step
  bool begins_anew = false;           // on restoring it starts afresh: its library does not expose the steps that it
                                      // remembers
  AmplificationRadius amplification;  // empty if it has none (multistep)
  OscillatorStep oscillator_step;     // empty if local damping limits its step by the stiffness factor alone
};

/// The largest h that is stable for every mode and damping [s]. With local damping and several stages it comes from a
/// model of the body that is on the safe side of what is observed: no more than without damping, since at some degrees
/// of freedom the damping hardly ever acts, nor than for a single oscillator with omega_max, whose sign changes may
/// keep time with the step. In a body they hardly do so everywhere at once: motions begin to grow there at up to twice
/// as long a step.
double critical_step(const Method& method, const Damping& damping, const DampedSpectrum& spectrum);

/// All available methods, in the order of `stillpoint list integrators`.
std::vector<Method> methods();
/// One method by name; for leapfrog and symplectic-euler the treatment decides stability.
/// Throws std::invalid_argument naming the nearest method if there is none of that name.
Method find_method(std::string_view name, DampingTreatment treatment = DampingTreatment::automatic);

/// Throws std::invalid_argument if options and method do not fit (a damping that does not go with the method, rtol for
/// a method without error estimate, a treatment that the method or the damping does not allow, max_step ≤ 0). The
/// system must outlive the integrator.
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

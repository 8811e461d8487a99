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

/// What an iteration carries over from one phase to the next, whose unknowns are others.
struct CarriedOver {
  double last_step = 0;        // v was known half of this ago [s]
  std::optional<double> rate;  // the c found so far [1/s]
  double step_share = 0;       // of the step given, that the relaxation came to; 0: its own first one
};

/// What one call of step() did.
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
  /// Begins at (t, y), y: (2n), which stays the caller's and must outlive the integration.
  virtual void start(double t, Vector& y) = 0;
  /// One accepted step, never past t_stop. A fixed step is the largest not above max_step of which a whole number
  /// reaches t_stop, so that equal steps land on every output time. After a failure y holds the last good state.
  virtual StepReport step(double t_stop) = 0;
  /// Lowers or raises max_step from the next step on, if the critical step changes with the state. h > 0 [s].
  virtual void set_max_step(double h) = 0;
  /// v in y was changed at the present t, as by a contact that closed; u was not.
  virtual void velocity_changed() = 0;
  /// u in y was changed as well, as by a contact that put back what had gone too far: the force is evaluated anew.
  virtual void displacement_changed() = 0;
  /// Whether the system's last force evaluation was at the present (t, y), so that its residual costs nothing.
  virtual bool force_is_current() const { return false; }
  /// ‖F − R‖ at the present (t, y) [N], if it was found on the way.
  virtual std::optional<double> unbalanced_force() const { return std::nullopt; }
  /// M⁻¹p at the present y = [u; p], of a mass that is known by its inverse, if it was found on the way: (n) [m/s],
  /// until the next step; else empty.
  virtual ConstVec velocity() const { return {}; }
  /// M⁻¹(F − R) at the present (t, y) [m/s²], likewise.
  virtual ConstVec acceleration() const { return {}; }
  /// ω₁ [rad/s] of the motions that the loads drive, if its steps have come to tell; it may cost some of them.
  virtual std::optional<double> lowest_frequency() const { return std::nullopt; }
  /// The damping c at present [1/s], if a relaxation finds it on the way.
  virtual std::optional<double> damping_rate() const { return std::nullopt; }
  /// What an integrator of the same kind has to be given to carry on in the next phase.
  virtual CarriedOver carried_over() const { return {}; }
  /// Whether steps are iterates of a static solver: laws of the material remember the last one only.
  virtual bool static_iteration() const { return false; }
  /// Saves what the next steps depend on beside (t, y) and the system, or restores it after a start() at the (t, y) of
  /// then: unless Method::begins_anew, the same steps follow.
  virtual void archive(const StateArchive& state) = 0;
  virtual long steps() const = 0;           // accepted
  virtual long rejected_steps() const = 0;  // tried and refused by the error control or as inadmissible
};

/// What is known of a method before it runs.
struct Method : MethodInfo {
  int order = 0;                      // of the fixed-step solution
  int evaluations_per_step = 0;       // right-hand sides a fixed step costs when implemented right; 0: not fixed
  bool remembers_force = false;       // knows Q of the last accepted step, as Damping::uses_last_force() needs
  bool hosts_relaxations = false;     // relaxations are iterations in the place of its step
  bool begins_anew = false;           // when restored: its library keeps what it remembers of steps to itself
  AmplificationRadius amplification;  // empty if it has none (multistep)
  OscillatorStep oscillator_step;     // empty if local damping limits its step by the stiffness factor alone
};

/// The largest h that is stable for every mode and damping [s]. With local damping and several stages a model of the
/// body, on the safe side of what is seen: no more than without damping, as at some degrees of freedom it hardly ever
/// acts, nor than for a single oscillator with omega_max, whose switches may keep time with the step. In a body they
/// hardly do so everywhere at once: motions begin to grow there at up to twice as long a step.
double critical_step(const Method& method, const Damping& damping, const DampedSpectrum& spectrum);

/// Every method on offer, in the order of `stillpoint list integrators`.
std::vector<Method> methods();
/// One method by name; for leapfrog and symplectic-euler the treatment decides stability.
/// Throws std::invalid_argument naming the nearest method if there is none of that name.
Method find_method(std::string_view name, DampingTreatment treatment = DampingTreatment::automatic);

/// Throws std::invalid_argument if options and method do not fit (a damping that does not go with it, rtol for a method
/// without error estimate, a treatment that the method or the damping does not allow, max_step ≤ 0). The system
/// outlives the integrator.
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

// Time integration of y' = f(t, y), y = [u; v], behind one interface.
//
//   leapfrog, symplectic-euler   our own, one force evaluation a step
//   erk:<table>                  SUNDIALS' ARKODE (ERKStep): every packaged explicit table and three of our own
//   gsl:<stepper>                GSL's explicit steppers, an independent second opinion
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/stability.hpp>
#include <stillpoint/stepper.hpp>

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
std::unique_ptr<Stepper> make_integrator(const IntegratorOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

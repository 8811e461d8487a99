// Relaxations: iterations to rest that find their own damping. Each takes the place of leapfrog's step and has a file
// in src/solvers/relaxation:
//
//   kinetic     v = 0 at every peak of the kinetic energy                   (with erk:* by ARKODE's root finding)
//   adaptive, papadrakakis, chebyshev, nesterov                             v⁺ = β v⁻ + γ h M⁻¹Q,  u⁺ = u + h v⁺
//   fire, fire2                                                             the same, v turned towards M⁻¹Q
//   auto                                                                    conjugate directions, or as adaptive
#pragma once

#include <stillpoint/integrator.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct RelaxationOptions {
  std::string name = "auto";
  double max_step = 0;                   // the step given, a share of leapfrog's critical step [s]; > 0
  Peak peak = Peak::half_step;           // for kinetic
  Quotient quotient = Quotient::global;  // for adaptive
  double omega_1 = 0;                    // for chebyshev [rad/s]; it derives ω_max from max_step
  bool steady = true;                    // for auto: the loads do not depend on t, so that velocities may be reset
  bool single_phase = true;              // for auto: no other phase will follow
  std::optional<bool> path_dependent{};  // and whether an equilibrium depends on the way to it, as with a yielding law
                                         // or friction; empty: if the system is history_dependent()
  bool linear = false;                   // for auto: Q is linear in u
  CarriedOver from{};
};

/// The properties of a relaxation that are known before it begins.
struct RelaxationInfo {
  StrategyInfo about;
  bool needs_omega_1 = false;
  bool chooses_mass = false;     // chooses the mass, and estimates ω_max by a few products with K, since it monitors
                                 // its own step
  double step_fraction = 0;      // share of the critical step, if it prescribes one
  bool needs_upper_end = false;  // needs a step strictly below the critical one, for which an estimate is not enough
  bool is_event_of_erk = false;  // with erk: methods it is an event at which the integrator halts
};

/// All relaxations, in the order of `stillpoint list`.
const std::vector<RelaxationInfo>& relaxations();
/// The relaxation of this name; null if there is none.
const RelaxationInfo* find_relaxation(std::string_view name);

/// Makes a relaxation. Throws std::invalid_argument for an unknown name, and for options that the relaxation cannot
/// work with. The system's damping must add no force; the system must outlive the relaxation.
std::unique_ptr<Stepper> make_relaxation(const RelaxationOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

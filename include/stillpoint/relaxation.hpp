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
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct RelaxationOptions {
  std::string name = "auto";
  double max_step = 0;                   // the step given, a share of leapfrog's critical one [s]; > 0
  Peak peak = Peak::half_step;           // of kinetic
  Quotient quotient = Quotient::global;  // of adaptive
  double omega_1 = 0;                    // of chebyshev [rad/s]; ω_max it has from max_step
  bool steady = true;                    // of auto: the loads do not depend on t, so that velocities may be reset
  bool single_phase = true;              // of auto: no other will follow
  bool linear = false;                   // of auto: Q is linear in u
  CarriedOver from{};
};

/// What has to be known of a relaxation before it begins.
struct RelaxationInfo {
  StrategyInfo about;
  bool needs_omega_1 = false;
  bool chooses_mass = false;     // and estimates ω_max in a few products with K, since it watches its own step
  double step_fraction = 0;      // of the critical step, if it has its own
  bool needs_upper_end = false;  // the step must be below the critical one all the time, not nearly
  bool is_event_of_erk = false;  // with erk: methods it is an event at which the integrator halts
};

/// Every relaxation, in the order of `stillpoint list`.
const std::vector<RelaxationInfo>& relaxations();
/// One of them; null if there is none of that name.
const RelaxationInfo* find_relaxation(std::string_view name);

/// Throws std::invalid_argument for an unknown name, and for options that the relaxation cannot work with. The system's
/// damping adds no force; the system outlives the relaxation.
std::unique_ptr<Integrator> make_relaxation(const RelaxationOptions& options, RelaxationSystem& system);

}  // namespace stillpoint

// Damping strategies: the way to rest. Some are a force that is added to M a = Q, Q = F − R, and go with integrators:
//
//   none        M a = Q
//   viscous     M a = Q − c M v
//   identity    M a = Q − c v                          (the paper's: C = c I)
//   one-sided   M a = Q + D,  D_i = −α Q_i where v_i Q_i > 0, else 0        [Więckowski 2011, eq. 4]
//   cundall     M a = Q + D,  D_i = −α |Q_i| sgn v_i                        [Cundall 1987]
//   combined    M a = Q + D,  D_i = −α/2 |Q_i| (sgn v_i − sgn dQ_i/dt)      [Itasca, FLAC: combined damping]
//
// The others own their iteration, which takes the place of leapfrog's step; each has a file in src/strategies:
//
//   kinetic     v = 0 at every peak of the kinetic energy                   (with erk:* by ARKODE's root finding)
//   adaptive, papadrakakis, chebyshev, nesterov, auto                       v⁺ = β v⁻ + γ h M⁻¹Q,  u⁺ = u + h v⁺
//   fire, fire2                                                             the same, v turned towards M⁻¹Q
//   cg, lbfgs                                                               static iterations: R(u) = F without time
#pragma once

#include <stillpoint/scene_options.hpp>
#include <stillpoint/types.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// The linear part of the damping, C = mass · M + identity · I.
struct LinearDamping {
  double mass = 0;      // [1/s]
  double identity = 0;  // [kg/s]
};

class Damping {
 public:
  virtual ~Damping() = default;
  virtual std::string_view name() const = 0;
  /// C, so that integrators can treat it implicitly.
  virtual LinearDamping linear() const { return {}; }
  /// Whether add_local() does anything; then the right-hand side is discontinuous in v.
  virtual bool is_local() const { return false; }
  /// Q += D(v, Q), degree of freedom by degree of freedom; v, Q: (n).
  virtual void add_local(ConstVec /*v*/, Vec /*Q*/) const {}
  /// Whether D also needs Q of the last accepted step, as for the sign of dQ/dt; then add_local_since() is called in
  /// place of add_local().
  virtual bool uses_last_force() const { return false; }
  /// Q += D(v, Q − Q_last, Q); v, Q_last, Q: (n).
  virtual void add_local_since(ConstVec /*v*/, ConstVec /*Q_last*/, Vec /*Q*/) const {}
  /// The largest |Q + D|/|Q|: by this the critical step sees the stiffness grow (1 + α for Cundall's).
  virtual double stiffness_factor() const { return 1; }
};

/// What an iteration carries over from one phase to the next, where its unknowns are others.
struct CarriedOver {
  double last_step = 0;        // v was known half of this ago [s]
  std::optional<double> rate;  // the c found so far [1/s]
  double step_share = 0;       // of the step given, that the strategy came to; 0: its own first one
};

/// What strategies that own their iteration have to be told.
struct StrategyOptions {
  Peak peak = Peak::half_step;           // of kinetic
  Quotient quotient = Quotient::global;  // of adaptive
  double omega_1 = 0;                    // of chebyshev [rad/s]; ω_max it has from the critical step
  bool steady = true;                    // of auto: the pull does not depend on t, so that velocities may be reset
  CarriedOver from{};
};

struct DampingInfo {
  std::string_view name, equation, source;
  bool takes_c = false, takes_alpha = false;
  bool takes_peak = false, takes_quotient = false;
  bool needs_omega_1 = false;    // before it begins
  bool owns_iteration = false;   // in the place of leapfrog's step
  bool has_own_step = false;     // integrator.step and step_fraction have no part in it
  bool is_static = false;        // an iteration without time: a law remembers its last state only
  bool resets_velocity = false;  // of all unknowns, also of those that a wall drives
  /// The integrators that it goes with, by the beginning of their names; empty: all.
  std::vector<std::string_view> integrators{};

  bool goes_with(std::string_view method) const;
  /// Whether a key of [damping] beside the strategy ("c", "alpha", "peak", "quotient") says anything to it. Those that
  /// are a force let each other's c and alpha pass.
  bool takes(std::string_view key) const;
};
/// Every strategy, for `stillpoint list dampings`.
const std::vector<DampingInfo>& damping_strategies();
/// One of them, or null where there is none of that name: a damping of the user's own.
const DampingInfo* known_damping(std::string_view name);
/// One of them. Throws std::invalid_argument where there is none of that name.
const DampingInfo& find_damping(std::string_view name);

/// Makes a strategy by its name; c for viscous and identity, alpha for one-sided, cundall and combined. One that owns
/// its iteration adds no force: make_integrator() knows it by its name.
/// Throws std::invalid_argument on an unknown name or a parameter out of range (c < 0, α outside [0, 1)).
std::unique_ptr<Damping> make_damping(std::string_view name, double c, double alpha);

}  // namespace stillpoint

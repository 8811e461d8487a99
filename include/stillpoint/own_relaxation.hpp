// User-defined relaxations, which scenes name like the built-in ones: an iteration in the place of leapfrog's step that
// costs one force evaluation,
//
//   (u, v) → (u⁺, v⁺)   from   u, v, Q = F − R(u), a = M⁻¹Q.
#pragma once

#include <stillpoint/relaxation.hpp>

#include <functional>
#include <memory>
#include <string>

namespace stillpoint {

/// The present state, (n) each; valid during the call that receives it.
struct MotionNow {
  double t = 0;          // the pseudo-time [s]
  double last_step = 0;  // length of the previous step [s]; 0: there is none since the phase began
  double max_step = 0;   // the largest step allowed [s]
  double omega_1 = 0;    // [rad/s]; 0 unless needs_omega_1
  ConstVec u, v;         // displacement since the phase began [m], velocity [m/s]
  ConstVec Q, a;         // out-of-balance force [N], M⁻¹Q [m/s²]
  const Mass* mass = nullptr;
};

class OwnRelaxation {
 public:
  virtual ~OwnRelaxation() = default;
  /// Called when a phase begins, or when a contact has changed velocities.
  virtual void restart(const MotionNow&) {}
  /// The trial u⁺, v⁺ of a step h; (n) each, holding zeros or an earlier trial. Has to be repeatable: after a trial
  /// that cannot be evaluated it is called again with a shorter step.
  virtual void propose(double h, const MotionNow& now, Vec u_new, Vec v_new) = 0;
  /// Called when the trial has become the state.
  virtual void moved(double /*h*/, const MotionNow&) {}
  /// Saves or restores, for checkpoints, what the relaxation itself remembers of earlier steps.
  virtual void archive(const StateArchive& /*state*/) {}
};

struct OwnRelaxationInfo {
  std::string name;  // value of damping.strategy: lower-case letters, digits and hyphens
  std::string equation{}, source{};
  bool needs_omega_1 = false;
};

/// Makes the relaxation of a phase; called once a phase.
using MakeOwnRelaxation = std::function<std::unique_ptr<OwnRelaxation>()>;

/// Registers a relaxation: damping.strategy = name uses the objects that make() returns from now on. It replaces a
/// relaxation of that name added before. An exception of a relaxation ends the step and reaches the caller. Throws
/// std::invalid_argument if the name is malformed, or one of this library's.
void add_relaxation(const OwnRelaxationInfo& about, MakeOwnRelaxation make);

}  // namespace stillpoint

// A relaxation of a program's own, which scenes then name like any other: an iteration in the place of leapfrog's step
// that costs one force evaluation,
//
//   (u, v) → (u⁺, v⁺)   from   u, v, Q = F − R(u), a = M⁻¹Q.
#pragma once

#include <stillpoint/relaxation.hpp>

#include <functional>
#include <memory>
#include <string>

namespace stillpoint {

/// The present state, (n) each; valid during the call that it is given to.
struct MotionNow {
  double t = 0;          // the pseudo-time [s]
  double last_step = 0;  // of the step before [s]; 0: there is none since the phase began
  double max_step = 0;   // the step given [s]
  double omega_1 = 0;    // [rad/s]; 0 unless needs_omega_1
  ConstVec u, v;         // displacement since the phase began [m], velocity [m/s]
  ConstVec Q, a;         // out-of-balance force [N], M⁻¹Q [m/s²]
  const Mass* mass = nullptr;
};

class OwnRelaxation {
 public:
  virtual ~OwnRelaxation() = default;
  /// A phase begins, or velocities were changed by a contact.
  virtual void restart(const MotionNow&) {}
  /// The trial u⁺, v⁺ of a step h; (n) each, zeros or an earlier trial. Repeatable: a trial that cannot be evaluated is
  /// asked for again with a shorter step.
  virtual void propose(double h, const MotionNow& now, Vec u_new, Vec v_new) = 0;
  /// The trial has become the state.
  virtual void moved(double /*h*/, const MotionNow&) {}
  /// What it remembers itself of earlier steps, for checkpoints.
  virtual void archive(const StateArchive& /*state*/) {}
};

struct OwnRelaxationInfo {
  std::string name;  // of damping.strategy: lower-case letters, digits and hyphens
  std::string equation{}, source{};
  bool needs_omega_1 = false;
};

/// Called once a phase.
using MakeOwnRelaxation = std::function<std::unique_ptr<OwnRelaxation>()>;

/// From now on damping.strategy = name relaxes by what make() makes. In the place of one of that name that
/// was added before. What a relaxation throws ends the step and reaches the caller. Throws std::invalid_argument if the
/// name is no word, or one of this library's.
void add_relaxation(const OwnRelaxationInfo& about, MakeOwnRelaxation make);

}  // namespace stillpoint

// Whether a body that is let go comes to rest or moves on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct RestOrMotion {
  enum class End { rests, moves, undecided, interrupted } end = End::undecided;
  std::string reason{};
  std::vector<double> u{};  // (n), at the end
  long evaluations = 0;
};

struct MotionLimits {
  double residual = 1e-6;  // ‖F − R‖/‖F‖ that counts as rest
  int periods = 200;       // of 2π/ω₁ at most
  /// Asked from time to time, whether a static solver finds an equilibrium at t from u, (n), which it then writes
  /// there; otherwise it changes nothing. Empty: there is none.
  std::function<bool(double t, Vec u)> settles{};
  std::function<bool()> interrupted{};
};

/// The motion from u at rest under C = 2 ω₁ M, in the present phase, with loads that have settled. Under that damping a
/// body that slides at a constant force keeps its residual and its velocity, and one that comes to rest loses both: its
/// residual falls with the way that it makes. The body moves if the residual, falling as it did over the last half of
/// the time, would be 0 no sooner than after half of the way that was made since the start once more, and so for
/// several periods.
RestOrMotion rest_or_motion(LagrangianPhase& phase, double t, ConstVec u, const MotionLimits& limits);

}  // namespace stillpoint

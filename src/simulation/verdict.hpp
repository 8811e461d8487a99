// How a run ends: its status, and the reason in words. If it went wrong, the reason says when and where that was.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <string>

#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The outcome of a test of a run: by default the run goes on.
struct Verdict {
  RunStatus status = RunStatus::running;
  std::string reason{};

  bool ends() const { return status != RunStatus::running; }
};

/// A moment of a run.
struct Moment {
  double t = 0;  // [s]
  long steps = 0;
  int phase = 1;
};

/// The run has failed at that moment: "at t = 0.31 s, after 120 steps, in phase 3: " and what happened.
Verdict failure(const Moment& moment, const std::string& what);

/// The same for a step that was given up, whose report tells failure from divergence. If a formula of the scene has no
/// finite value within that step, this is what happened.
Verdict failure_of_step(const Problem& problem, const LagrangianPhase& phase, const Moment& moment,
                        const StepReport& report);

/// "material point 12 at (0.5, 0.25) in cell (3, 1) is stressed most, by 3e+08 Pa" at (t, u).
std::string most_stressed(const LagrangianPhase& phase, double t, ConstVec u);

/// The nodes that are furthest from rest at t: the one with the largest out-of-balance force, and the fastest one.
std::string furthest_from_rest(PhaseMotion& motion, double t);

}  // namespace stillpoint

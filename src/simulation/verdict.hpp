// How a run ends: its status and the reason in words, and what a reason says of a run that goes wrong.
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

/// A formula or a load of the program's own that is no finite number in the step from t to t + step [s],
/// "body_force.value is not a number at t = 0.3 at material point 12 at (0.5, 0.25)"; empty: all have values.
std::string load_without_value(const Problem& problem, const LagrangianPhase& phase, double t, double step);

/// "material point 12 at (0.5, 0.25) in cell (3, 1) is stressed most, by 3e+08 Pa" at (t, u).
std::string most_stressed(const LagrangianPhase& phase, double t, ConstVec u);

/// The nodes that are furthest from rest at t: the one with the largest out-of-balance force, and the fastest one.
std::string furthest_from_rest(PhaseMotion& motion, double t);

}  // namespace stillpoint

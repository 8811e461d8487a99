// What is said of a run that goes wrong: when, where, which quantity, what to try.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>

#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// A moment of a run.
struct Moment {
  double t = 0;  // [s]
  long steps = 0;
  int phase = 1;
};

/// "at t = 0.31 s, after 120 steps, in phase 3: " and what happened.
std::string failure(const Moment& moment, const std::string& what);

/// Of a step that was given up: also a formula of the scene that is no finite number within it, if there is one.
std::string failure_of_step(const Problem& problem, const LagrangianPhase& phase, const Moment& moment,
                            const StepReport& report);

/// "material point 12 at (0.5, 0.25) in cell (3, 1) is stressed most, by 3e+08 Pa" at (t, u).
std::string most_stressed(const LagrangianPhase& phase, double t, ConstVec u);

/// Where a run that has not come to rest at t is furthest from it: the node with the largest out-of-balance force, and
/// the one that is fastest.
std::string furthest_from_rest(PhaseMotion& motion, double t);

}  // namespace stillpoint

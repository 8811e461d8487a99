// A body that its supports do not hold, or whose grid has more unknowns than its material points resist: a motion that
// strains nothing, K x = 0, and on which the loads do work, Q·x ≠ 0, is never at rest.
#pragma once

#include <stillpoint/problem.hpp>

#include <optional>
#include <string>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct FoundMechanism {
  bool is_rigid = false;    // true if the body moves as a whole, so that a support is missing
  std::string description;  // the motion, in words
};

/// The mechanism that the loads at (t, u) drive. Empty: every motion that they drive is resisted, or this cannot be
/// said: in many phases a motion that strains nothing now does so later, a body that turns by a finite angle may come
/// to rest hanging, and what touches it may hold it. Factorises a matrix of the size of K.
std::optional<FoundMechanism> find_mechanism(const LagrangianPhase& phase, double t, ConstVec u);

/// "the body is not held: nothing resists a motion in which …; its loads drive it …; expected …"
std::string to_string(const FoundMechanism& mechanism);

/// Throws SceneError if the scene asks for equilibrium and there is a mechanism under its last loads. u: at the start.
void refuse_mechanism(const Problem& problem, const LagrangianPhase& phase, ConstVec u);

}  // namespace stillpoint

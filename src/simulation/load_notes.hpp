// What a user should know of a scene's loads and supports before it is run.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// A sentence each: on loads that are zero or act on supports only, on supports that hold nothing, on what nothing
/// holds. u: where the motion begins, (n). Throws SceneError if equilibrium is asked for, and a part of the body that
/// nothing holds has loads that do not balance: it falls freely, and is never at rest.
std::vector<std::string> load_notes(const Problem& problem, const LagrangianPhase& phase, ConstVec u);

}  // namespace stillpoint

// What a user should know of a scene's accuracy before it is run.
#pragma once

#include <stillpoint/scene.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// A sentence each: on what the points integrate, on supports outside the body, on phases.
std::vector<std::string> accuracy_notes(const Scene& scene, const LagrangianPhase& phase);

}  // namespace stillpoint

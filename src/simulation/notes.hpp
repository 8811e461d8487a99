// What a user should know of a scene's accuracy before it is run.
#pragma once

#include <stillpoint/scene.hpp>

#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// A sentence each: on what the points integrate, on supports outside the body, on phases.
std::vector<std::string> accuracy_notes(const Scene& scene, const LagrangianPhase& phase);

/// After a run of elastic bodies in phases, if much of the points' stresses is more than the grid's functions feel.
std::optional<std::string> null_space_note(const Scene& scene, const LagrangianPhase& phase, double null_space_stress);

}  // namespace stillpoint

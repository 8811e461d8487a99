// What a user should know of a scene's accuracy before it is run.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Of a run that goes without omega_1, as a factor of its stiffness costs too much.
std::string no_error_bound_note();

/// Where the grid has motions of its own in space that strain no point.
std::optional<std::string> hourglass_note(const Problem& problem);

/// A sentence each: on what the points integrate, on supports outside the body, on phases. scaled: whether the mass has
/// been scaled by Gershgorin's bound though the scene does not say so.
std::vector<std::string> accuracy_notes(const Problem& problem, const LagrangianPhase& phase, bool scaled);

/// Whether the lowest mode x moves the material, (n), or only functions that hardly reach the body.
std::vector<std::string> lowest_mode_notes(const Problem& problem, const LagrangianPhase& phase, ConstVec x,
                                           double omega_1);

/// If damping c M v beside the lowest frequency lets the body come to rest only after more steps, or more time, than
/// the scene allows. step: what is taken [s].
std::optional<std::string> slow_damping_note(const Problem& problem, double c, double omega_1, double step);

/// After a run that ended in equilibrium, if its error bound is large, as where the scene asks for none.
std::optional<std::string> distance_note(RunStatus status, std::optional<double> distance);

/// After a run in phases, if the displacements are no more than what positions are rounded to.
std::optional<std::string> lost_motion_note(const LagrangianPhase& phase, double t, ConstVec u, long phases);

}  // namespace stillpoint

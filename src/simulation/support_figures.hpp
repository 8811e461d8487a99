// The reactions of the supports of a scene, and how far those that hold by springs give way.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <string>
#include <vector>

#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Columns of history.csv: "<support>.reaction_x", "<support>.reaction_y" of each named support, in space
/// "<support>.moment_x" to z too; in one dimension "<support>.reaction".
std::vector<std::string> reaction_columns(const Problem& problem);
/// The values of these columns at (t, u), at which the system was evaluated last [N], [N m].
std::vector<double> reaction_values(const Problem& problem, const LagrangianPhase& phase, double t,
                                    PhaseMotion& motion);
/// Reactions and weak supports at (t, u), which is evaluated if there are any, with a note on what gives way too far.
void fill_supports(const Problem& problem, const LagrangianPhase& phase, double t, PhaseMotion& motion,
                   Summary& summary);

}  // namespace stillpoint

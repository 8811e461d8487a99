// The results of a convergence study from its levels: errors and their orders.
#pragma once

#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

#include "study/level_run.hpp"

namespace stillpoint {

/// Whether all levels have the same material points.
bool has_same_points(const std::vector<Refinement>& refine);

/// Fills quantities and reference, and adds notes; runs: one for each level of the study, in the order of its levels.
void gather_quantities(const Problem& problem, const std::vector<LevelRun>& runs, ConvergenceStudy& study);

/// The name of the quantity by which sources of error are compared: the error in u, or the first probe, or the change
/// of u itself.
std::string figure_of_sources(const std::vector<Refinement>& refine, const LevelRun& run);
/// The change of that quantity from one run to another; NaN if either has no value.
double change(const std::string& figure, const LevelRun& a, const LevelRun& b);

}  // namespace stillpoint

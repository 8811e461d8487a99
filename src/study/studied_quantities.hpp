// What a convergence study finds of its levels: errors, and their orders.
#pragma once

#include <stillpoint/converge.hpp>

#include <string>
#include <vector>

#include "study/level_run.hpp"

namespace stillpoint {

/// Whether material points are the same on all levels.
bool has_same_points(const std::vector<Refinement>& refine);

/// Fills quantities and reference, and adds notes; runs: of the levels, whose sizes are those in the study.
void gather_quantities(const Problem& problem, const std::vector<LevelRun>& runs, ConvergenceStudy& study);

/// The figure that sources of error are told by: the error in u, or the first probe, or how far u itself moves.
std::string figure_of_sources(const std::vector<Refinement>& refine, const LevelRun& run);
/// How far it is from one run to another; NaN if either has none.
double change(const std::string& figure, const LevelRun& a, const LevelRun& b);

}  // namespace stillpoint

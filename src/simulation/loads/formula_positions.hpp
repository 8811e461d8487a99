// The positions in a body at which a formula of a scene is evaluated.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Positions, (n × dim) [m], that stand for all at which the formula of a key such as "traction[0].value" is needed.
/// For a traction or a support these are a thousand along its line or face, or eight to a cell, none at the ends;
/// otherwise they are the material points.
std::vector<double> formula_positions(const Problem& problem, const LagrangianPhase& phase, const std::string& key);

}  // namespace stillpoint

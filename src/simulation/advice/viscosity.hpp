// Materials that flow at a rate where they are stressed beyond their strength: a body of them is at rest for good only
// once no point is.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The largest yield function over the strength that equilibrium takes: a share of this size would still come off the
/// stresses.
inline constexpr double largest_over_stress = 1e-3;

/// "it creeps: at …", and by how much the body is beyond its strength; empty: it does not creep. A pass over all
/// points.
std::string creep(const Problem& problem, const LagrangianPhase& phase);

/// Notes on viscous materials that a user should know before a run: a static solver has no viscosity, or their flow
/// takes longer than the run may. step: [s].
std::vector<std::string> viscosity_notes(const Problem& problem, double step);

}  // namespace stillpoint

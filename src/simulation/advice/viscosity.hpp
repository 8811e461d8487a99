// Materials that flow at a rate where they are stressed beyond their strength: a body of them is at rest for good only
// once no point is.
#pragma once

#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The yield function over the strength that equilibrium takes. Of what is left of it a share of this size would still
/// come off the stresses.
inline constexpr double largest_over_stress = 1e-3;

/// Where the body creeps, and by how much it is beyond its strength; empty: it does not. A pass over all points.
std::string creep(const Problem& problem, const LagrangianPhase& phase);

/// What a user should know of viscous materials before a run: that a static solver has none, or that their flow takes
/// longer than the run may. step: [s].
std::vector<std::string> viscosity_notes(const Problem& problem, double step);

}  // namespace stillpoint

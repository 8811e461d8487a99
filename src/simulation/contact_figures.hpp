// What touches in a scene, as columns of history.csv and in the summary.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// For each rigid body, and for each contact "a+b", "<name>.force_x", "_y", "_z" as there are; "<name>.moment_z", in
/// space "_x" to "_z", not in an axisymmetric scene; "<name>.contact_area", "<name>.penetration", and with friction
/// "<name>.slipping"; for a free rigid body "<name>.displacement_x", "_y", "_z".
std::vector<std::string> contact_columns(const Problem& problem);
/// The values of these columns at (t, u) [N], [N m], [m²], [cells], share, [m].
std::vector<double> contact_values(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);
/// The same for the summary.
void fill_contacts(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, Summary& summary);

}  // namespace stillpoint

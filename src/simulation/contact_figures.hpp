// What the rigid bodies of a scene exert, as columns of history.csv and in the summary.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// For each rigid body "<name>.force_x", "_y", "_z" as there are; "<name>.moment_z", in space "_x" to "_z", not in an
/// axisymmetric scene; "<name>.contact_area", "<name>.penetration", and with friction "<name>.slipping".
std::vector<std::string> rigid_columns(const Problem& problem);
/// The values of these columns at (t, u) [N], [N m], [m²], [cells], share.
std::vector<double> rigid_values(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);
/// The same for the summary.
void fill_rigid(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, Summary& summary);

}  // namespace stillpoint

// What a user should know of a problem: its accuracy, its loads and its cells before the run, its answer after it. Each
// note is a sentence.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Notes on what the points integrate, on supports outside the body, on phases and on cells that lock. scaling: of the
/// mass that was chosen.
std::vector<std::string> accuracy_notes(const Problem& problem, const LagrangianPhase& phase, MassScaling scaling);

/// Notes on what the points integrate, in the cells inside and in those that a body's border cuts.
std::vector<std::string> quadrature_notes(const Problem& problem, const LagrangianPhase& phase, MassScaling scaling);
/// A note if a material is nearly incompressible, or flows plastically, and no remedy is chosen: the cells lock, since
/// their points must keep to more than their nodes can do.
std::optional<std::string> locking_note(const Problem& problem);
/// A note on long cells of a linear basis, which lock where the body bends; empty if they are not that long.
std::optional<std::string> slender_cells_note(const Problem& problem);
/// A note if the run begins with points of another one that fill the cells of its grid unevenly.
std::optional<std::string> uneven_points_note(const Problem& problem, const LagrangianPhase& phase);
/// A note if the grid has motions of its own in space that strain no point.
std::optional<std::string> hourglass_note(const Problem& problem);

/// Notes on loads that are zero or act on supports only, on supports that hold nothing, on what nothing holds. u: where
/// the motion begins, (n). Throws SceneError if equilibrium is asked for, and a part of the body that nothing holds has
/// loads that do not balance: it falls freely, and is never at rest.
std::vector<std::string> load_notes(const Problem& problem, const LagrangianPhase& phase, ConstVec u);

/// The share of the kinetic energy of a motion x, (n), that is in the material, and not in inertia that functions which
/// hardly reach the body have beyond what they move.
double share_in_material(const Problem& problem, const LagrangianPhase& phase, ConstVec x);
/// What that share has to be for a mode to count as a motion of the body.
constexpr double least_share_in_material = 0.1;
/// A note on a lowest mode that has less.
std::string lowest_mode_note(double omega_1, double share);

/// A note if damping c M v beside the lowest frequency lets the body come to rest only after more steps, or more time,
/// than the problem allows. step: what is taken [s].
std::optional<std::string> slow_damping_note(const Problem& problem, double c, double omega_1, double step);

/// A note after a run that ended in equilibrium, if its error bound is large, as it may be if no key asks for one.
std::optional<std::string> distance_note(RunStatus status, std::optional<double> distance);

/// A note after a run in phases, if the displacements are no more than what positions are rounded to.
std::optional<std::string> lost_motion_note(const LagrangianPhase& phase, double t, ConstVec u, long phases);

// Materials that flow at a rate where they are stressed beyond their strength: a body of them is at rest for good only
// once no point is.
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

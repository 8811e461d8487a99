// The beginning of a run with the points of another.
#pragma once

#include <stillpoint/problem.hpp>

#include <memory>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"
#include "space/points/carried_points.hpp"

namespace stillpoint {

/// The points that the checkpoint of problem.initial_from left, for the bodies of the problem. Throws SceneError if it
/// cannot be read, is of another kind of body, or has a body that the problem lacks. notes: what a user should know of
/// them is added there.
std::shared_ptr<CarriedBody> points_of_other_run(const Problem& problem, std::vector<std::string>& notes);
/// Throws SceneError if these points are too few for the grid of the problem. phase: the first one, at its begin.
void refuse_sparse_points(const Problem& problem, const LagrangianPhase& phase);

}  // namespace stillpoint

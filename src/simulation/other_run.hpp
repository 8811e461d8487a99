// The beginning of a run with the points of another.
#pragma once

#include <stillpoint/problem.hpp>

#include <memory>

#include "space/points/carried_points.hpp"

namespace stillpoint {

/// The points that the checkpoint of problem.initial_from left, for the bodies of the problem. Throws SceneError if it
/// cannot be read, is of another kind of body, or has none of the problem's bodies.
std::shared_ptr<CarriedBody> points_of_other_run(const Problem& problem);

}  // namespace stillpoint

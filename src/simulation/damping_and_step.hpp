// How a run goes to rest: its damping, the step and the tolerances of what takes it.
#pragma once

#include <stillpoint/problem.hpp>

#include "simulation/model.hpp"

namespace stillpoint {

/// After the frequencies: sets c, the damping, the step and what the integrator or the relaxation is made of. A note if
/// the damping holds the motion back. Throws SceneError as make_model().
void choose_damping_and_step(const Problem& problem, SetUp& set_up, Model& model);

}  // namespace stillpoint

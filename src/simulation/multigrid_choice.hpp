// Whether a run takes a multigrid mass: asked for by its scene, or by auto where it pays.
#pragma once

#include <stillpoint/problem.hpp>

#include "simulation/model.hpp"
#include "simulation/set_up_store.hpp"

namespace stillpoint {

/// Sets multigrid, the frequencies that it makes and what a user should know of it; leaves all as it is where the
/// scene does not ask for it and auto does better without. After u. Throws SceneError if the scene asks for what cannot
/// be had.
void choose_multigrid(const Problem& problem, SetUp& set_up, Model& model);

/// For the phase that has just begun: the mass, its highest frequency and the steps that go with it. Throws SceneError
/// if there is none for what the body is like now, and leaves the model as it was.
void follow_multigrid(const Problem& problem, Model& model);

/// Whether less is spent with multigrid than without, by an elastic body of so many unknowns in one phase that nothing
/// touches; false where the scene settles it.
bool multigrid_pays(const Problem& problem, double unknowns, bool linear);

}  // namespace stillpoint

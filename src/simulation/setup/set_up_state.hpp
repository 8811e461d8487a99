// A set-up under way, and its parts in the order in which make_model() goes through them after the initial state.
#pragma once

#include "plan/plan.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/setup/set_up_store.hpp"

namespace stillpoint {

/// The parts fill the model by the plan.
struct SetUpState {
  const Problem& problem;
  PhaseBegin begin;
  Plan plan;
  SetUp parts;
  Model model{};

  void note(std::string sentence) { model.notes.push_back(std::move(sentence)); }
  void note(const std::vector<std::string>& sentences) {
    model.notes.insert(model.notes.end(), sentences.begin(), sentences.end());
  }
};

/// Sets the multigrid mass with its frequencies; or, if the relaxation chooses its mass, the phase and ω_max of
/// physical masses or those by Gershgorin's bound, whichever gives the smaller κ. Then revises the plan. Throws
/// SceneError if the problem asks for a multigrid mass that cannot be had.
void choose_mass(SetUpState& set_up);
/// Sets ω_max for the step, unless it came with the mass. Throws SceneError if the initial state has none.
void find_omega_max(SetUpState& set_up);
/// Sets ω₁ by Lanczos' method on K⁻¹M if the plan needs it. Without one it throws SceneError if something cannot do
/// without, and leaves a note if equilibrium can.
void find_omega_1(SetUpState& set_up);
/// Sets c, the damping, the step and what the integrator or the relaxation is made of. Leaves a note if the damping
/// holds the motion back. Throws SceneError as make_model().
void choose_damping_and_step(SetUpState& set_up);

}  // namespace stillpoint

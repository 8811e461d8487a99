// Factories of phases, with one source file for each kinematics, so that they compile in parallel.
#pragma once

#include <stillpoint/material.hpp>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of(const Problem& problem, const PhaseBegin& begin);

/// Makes a phase in which points represent domains; on a line and in the plane.
template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of_domains(const Problem& problem, const PhaseBegin& begin);

}  // namespace stillpoint

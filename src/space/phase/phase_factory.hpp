// One source file for each kinematics, so that they compile side by side.
#pragma once

#include <stillpoint/material.hpp>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of(const Problem& problem);

/// The same where points stand for domains; on a line and in the plane.
template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of_domains(const Problem& problem);

}  // namespace stillpoint

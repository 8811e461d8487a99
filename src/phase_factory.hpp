// One source file for each kinematics, so that they compile side by side.
#pragma once

#include <stillpoint/lagrangian_phase.hpp>
#include <stillpoint/material.hpp>

namespace stillpoint {

template <Kinematics K>
std::unique_ptr<LagrangianPhase> make_phase_of(const Scene& scene);

}  // namespace stillpoint

// How far displacements are from others, by the volume of the body that is displaced:
//
//   ‖u‖_V² = ∫ |u|² dV,   V the mass matrix of density 1
//
// The M-norm is as good as long as all of the body has the same density. Otherwise it overlooks what is light; and if
// the mass is scaled by the stiffness, what is soft.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/problem.hpp>

#include <optional>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct VolumeNorm {
  Mass V;              // (n × n) [m³]
  double omega_1 = 0;  // ω₁² the lowest eigenvalue of K x = ω² V x
};

/// Whether the M-norm is as good; scaled: whether the masses are.
bool mass_measures_volume(const Problem& problem, bool scaled);

/// Nothing if the M-norm of phase is as good, or K has no lowest eigenvalue; phase: of scene, with its masses scaled or
/// not, u: (n) at the beginning.
std::optional<VolumeNorm> volume_norm(const Problem& problem, const LagrangianPhase& phase, bool scaled, ConstVec u);

}  // namespace stillpoint

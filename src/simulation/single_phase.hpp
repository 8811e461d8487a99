// How far a body that yields has gone in a single phase, whose grid and weights are those of its start.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct SinglePhaseStrain {
  double strain = 0;      // the largest component of ∂u/∂x at the points
  std::size_t point = 0;  // where
};

/// At (t, u); empty if the points move on, or nothing remembers its path:
/// a hyperelastic body is computed rightly at any strain in one phase.
///
/// Beyond the limit load of a body that yields no equilibrium is left, and the residual ends at the share of the load
/// that it does not bear; but the frozen grid stiffens as it is squeezed, and bears any load in the end.
std::optional<SinglePhaseStrain> strain_in_single_phase(const LagrangianPhase& phase, double t, ConstVec u);
/// Beyond this a run of one phase ends in no equilibrium: the material has gone nearly as far as its own size, which
/// twice the load that it bears takes it to.
inline constexpr double largest_single_phase_strain = 0.9;
/// What to say of it; empty: nothing.
std::string note_on_single_phase(std::optional<double> strain);

}  // namespace stillpoint

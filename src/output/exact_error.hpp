// The error of a state relative to the scene's exact solution.
#pragma once

#include <stillpoint/summary.hpp>

#include <optional>
#include <span>
#include <string>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// ‖u_h − u‖/‖u‖ over the material points with weights V_p, at (t, u), and the same norm of the Cauchy stress with
/// ‖σ‖² = σ:σ; the stress is that of the last commit. Empty if the scene gives no exact solution or it vanishes.
std::optional<ExactError> exact_error(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);

/// σ:σ from the components xx; or xx, yy, zz, xy; or those and yz, zx.
double contracted(std::span<const double> sigma);

/// The error in the energy norm of linear elasticity, [Σ V (σ_h − σ):C⁻¹:(σ_h − σ)/Σ V σ:C⁻¹:σ]^½ over the material
/// points, with C the moduli of each point; or the reason why there is none.
struct EnergyError {
  std::optional<double> relative;
  std::string why_not;
};
EnergyError energy_error(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);

}  // namespace stillpoint

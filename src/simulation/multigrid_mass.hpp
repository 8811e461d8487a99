// A mass whose M⁻¹ is one cycle of multigrid on the elastic K. On the way to rest inertia is fictitious, and with this
// one all frequencies of M⁻¹K lie close together: whatever comes to rest by steps does so in a dozen or two, however
// many unknowns there are.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/scene.hpp>

#include <cstddef>
#include <memory>
#include <string>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct MultigridMass {
  Mass mass;
  double omega_1 = 0, omega_max = 0;  // of M⁻¹K, not below the lowest and not above the highest but by their errors
  int applications = 0;               // of K, that they took
  int levels = 0;
  std::size_t bytes = 0;
};

/// With the elastic K at (0, u). Frequencies to a few per cent; only_omega_max: ω₁ stays 0, in fewer applications.
/// Throws SceneError if the program has no PETSc, or if K is not positive definite.
std::shared_ptr<const MultigridMass> make_multigrid_mass(const Scene& scene, const LagrangianPhase& phase, ConstVec u,
                                                         bool only_omega_max);

/// Whether auto takes multigrid for a linear body of so many unknowns in one phase, that nothing touches: as the scene
/// leaves it open, and less is spent than without.
bool multigrid_pays(const Scene& scene, double unknowns);

}  // namespace stillpoint

// A mass whose M⁻¹ is one cycle of multigrid on the elastic K. On the way to rest inertia is fictitious, and with this
// one all frequencies of M⁻¹K lie close together: whatever comes to rest by steps does so in a dozen or two, however
// many unknowns there are.
#pragma once

#include <stillpoint/mass.hpp>

#include <memory>
#include <string>

#include "linalg/multigrid.hpp"
#include "simulation/set_up_store.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct MultigridMass {
  Mass mass;
  double omega_1 = 0, omega_max = 0;  // of M⁻¹K, not below the lowest and not above the highest but by their errors
  int applications = 0;               // of K, that they took
  std::shared_ptr<const Multigrid> cycle;
  NodalLayout layout;  // of the cycle's unknowns
  double spread = 0;   // highest to lowest Ritz value of a few Lanczos steps, when the cycle was made
};

struct MultigridAttempt {
  std::shared_ptr<const MultigridMass> mass;  // null if there is none:
  std::string refusal;                        // then why, with what was expected
};

/// With the elastic K at (0, u); there is none if the program has no PETSc, or if K is not positive definite.
/// Frequencies to a few per cent; only_omega_max: ω₁ stays 0, in fewer applications.
MultigridAttempt make_multigrid_mass(const LagrangianPhase& phase, ConstVec u, bool only_omega_max);
/// For a later phase, at u = 0, with the stable K there: by the cycle of the last one, carried to the unknowns that
/// there are now, while frequencies spread less than twice as far as when it was made; else, or with no last, by
/// another one. ω₁ stays 0.
MultigridAttempt next_multigrid_mass(const LagrangianPhase& phase, const MultigridMass* last);
/// As make_multigrid_mass(), or what others have made of a body with this mass.
MultigridAttempt shared_multigrid_mass(SetUp& set_up, const MassSpec& mass, const LagrangianPhase& phase, ConstVec u,
                                       bool only_omega_max);

}  // namespace stillpoint

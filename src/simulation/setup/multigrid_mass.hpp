// A mass whose M⁻¹ is one cycle of multigrid on the elastic K. On the way to rest inertia is fictitious, and with this
// one all frequencies of M⁻¹K lie close together: whatever comes to rest by steps does so in a dozen or two, however
// many unknowns there are.
#pragma once

#include <stillpoint/mass.hpp>

#include <memory>
#include <string>

#include "linalg/multigrid.hpp"
#include "simulation/setup/set_up_store.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct MultigridMass {
  Mass mass;
  double omega_1 = 0, omega_max = 0;  // the ends of the spectrum of M⁻¹K, but for their errors inside of it
  int applications = 0;               // products with K that they took
  std::shared_ptr<const Multigrid> cycle;
  NodalLayout layout;  // the positions of the cycle's unknowns
  double spread = 0;   // highest to lowest Ritz value of a few Lanczos steps, when the cycle was made
};

struct MultigridAttempt {
  std::shared_ptr<const MultigridMass> mass;  // null if there is none
  std::string refusal;                        // the reason why there is none, with what was expected
};

/// Makes a mass with the elastic K at (0, u); there is none if the program has no PETSc, or if K is not positive
/// definite. Frequencies are right to a few per cent; only_omega_max: ω₁ stays 0, in fewer applications.
MultigridAttempt make_multigrid_mass(const LagrangianPhase& phase, ConstVec u, bool only_omega_max);
/// Makes a mass for a later phase, at u = 0, with the stable K there: by the cycle of the last phase, carried to the
/// present unknowns, as long as frequencies spread less than twice as far as when it was made; otherwise, or if last is
/// null, by another cycle. ω₁ stays 0.
MultigridAttempt next_multigrid_mass(const LagrangianPhase& phase, const MultigridMass* last);
/// The same as make_multigrid_mass(), or what other simulations have made of a body with this mass.
MultigridAttempt shared_multigrid_mass(SetUp& set_up, const MassSpec& mass, const LagrangianPhase& phase, ConstVec u,
                                       bool only_omega_max);

}  // namespace stillpoint

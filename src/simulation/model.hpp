// Everything that a run is made of, from a scene: the phase, the damping, the frequencies and the step.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/relaxation.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/body_notes.hpp"
#include "simulation/multigrid_mass.hpp"
#include "simulation/set_up_store.hpp"
#include "simulation/volume_norm.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct Model {
  std::unique_ptr<LagrangianPhase> phase;
  MassSpec mass;                                   // that the phase was made with
  std::shared_ptr<const MultigridMass> multigrid;  // in the place of the phase's mass; null: there is none
  double multigrid_step = 0;                       // max_step omega_max, of all phases, once there is a second one
  std::vector<double> u, v;                        // initial values, (n) each
  bool linear = false;                             // whether Q = F − R is linear in u, and symmetric
  double t = 0;                                    // when it begins; the end of the loads for a static solver [s]
  std::optional<double> omega_1;                   // [rad/s]; only if something needs it and the body is held
  bool learns_omega_1 = false;                     // what is not known may show on the way, for the distance
  std::optional<VolumeNorm> volume_norm;           // if omega_1 is known, and errors are not measured by the mass
  double omega_max = 0;                            // [rad/s], by power iteration; for auto a bound by few Lanczos steps
  int tangent_applications = 0;                    // that auto spent on ω_max
  std::optional<double> c;                         // of viscous and identity damping
  std::unique_ptr<Damping> damping;
  Method method;
  const RelaxationInfo* relaxation = nullptr;       // in the place of the integrator's step; null: a damping
  const StaticMethodInfo* static_method = nullptr;  // in the place of any motion; null: there is one
  std::optional<double> critical_step;              // [s]; none for a multistep method
  // Ready to be made, whichever it is:
  IntegratorOptions integrator;
  RelaxationOptions relaxing;
  double dwell = 0;                   // how long equilibrium has to last [s]
  bool equilibrium_must_last = true;  // false if the residual bounds the error at every moment
  double distance_goal = 0;           // the error bound that equilibrium takes, relative; 0: no test of it
  // stiffening() at the beginning, if the step is to follow it: it was not asked for as such.
  std::optional<double> initial_stiffening;
  BodyNotes body_notes;
  std::vector<std::string> notes;  // what a user should know of this scene's accuracy, a sentence each
  std::vector<SetUpPart> parts;    // of the set-up, that take time
  double spared_s = 0;             // of their times: what was not spent again, as a store had it [s]
};

/// Throws SceneError for what only shows once the scene is discretised: a body that is not held if c = "critical", a
/// step past the critical one without a reason, a method that does not fit the damping. store: what others have found
/// of the same body; null: nobody has.
Model make_model(const Problem& problem, SetUpStore* store = nullptr);

}  // namespace stillpoint

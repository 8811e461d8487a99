// Everything that a run is made of: the phase, the damping, the frequencies and the step.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/relaxation.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "simulation/advice/body_notes.hpp"
#include "simulation/setup/multigrid_mass.hpp"
#include "simulation/setup/set_up_store.hpp"
#include "simulation/setup/volume_norm.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct Model {
  // The body at the start:
  std::unique_ptr<LagrangianPhase> phase;
  MassSpec mass;             // the phase's own; auto may have chosen another than the problem's
  std::vector<double> u, v;  // initial values, (n) each
  double t = 0;              // the start of the run or stage; for a static solver the end of its loads [s]

  // Its inertia and frequencies:
  std::shared_ptr<const MultigridMass> multigrid;  // in the place of the phase's mass; null: there is none
  double multigrid_step = 0;              // max_step omega_max, the same in all phases, once there is a second one
  std::optional<double> omega_1;          // [rad/s]; only if something needs it and the body is held
  bool learns_omega_1 = false;            // whether the steps may tell ω₁, and with it the distance
  std::optional<VolumeNorm> volume_norm;  // if omega_1 is known, and errors are not measured by the mass
  double omega_max = 0;                   // [rad/s]; for auto a bound by a few Lanczos steps
  int tangent_applications = 0;           // that auto spent on ω_max

  // The way to rest:
  const StaticMethodInfo* static_method = nullptr;  // as planned
  const RelaxationInfo* relaxation = nullptr;       // as planned
  bool factor_fits = false;                         // whether the machine has room for a factor of K, as planned
  std::optional<double> c;                          // the factor of viscous and identity damping
  std::unique_ptr<Damping> damping;
  Method method;
  std::optional<double> critical_step;       // [s]; none for a multistep method
  IntegratorOptions integrator;              // the integrator, or
  RelaxationOptions relaxing;                // the relaxation, is made of these
  std::optional<double> initial_stiffening;  // stiffening() at the start, if the step follows it

  // The tests of equilibrium:
  double dwell = 0;                   // the time that equilibrium has to last [s]
  bool equilibrium_must_last = true;  // false if the residual bounds the error at every moment
  double distance_goal = 0;           // the relative error bound that equilibrium takes; 0: it is not tested

  BodyNotes body_notes;
  std::vector<std::string> notes;  // for the user, on this problem's accuracy, a sentence each
  std::vector<SetUpPart> parts;    // parts of the set-up that take time
  double spared_s = 0;             // the part of these times that was not spent again, as a store had what it made [s]
};

/// Executes the plan of a problem. Throws SceneError for what only shows once the problem is discretised: a body that
/// is not held if c = "critical", a step past the critical one without a reason, a method that does not fit the
/// damping. store: what other simulations of the same body have made; null: nothing. begin: how a stage begins.
Model make_model(const Problem& problem, Plan plan, SetUpStore* store = nullptr, const PhaseBegin& begin = {});
/// Plans the problem first.
Model make_model(const Problem& problem, SetUpStore* store = nullptr);

/// Takes the multigrid mass, if there is one, to the phase that has just begun: the mass, its highest frequency and the
/// steps that go with it. Throws SceneError if there is none for what the body is like now, and leaves the model as it
/// was.
void follow_multigrid(const Problem& problem, Model& model);

}  // namespace stillpoint

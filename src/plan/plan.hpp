// What will be made for a problem on this machine, decided once, before anything of it is made. The set-up executes the
// plan; `stillpoint check`, its table of memory and the refusal of a run that needs too much read it.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/relaxation.hpp>

#include <string>
#include <vector>

#include "base/memory_room.hpp"
#include "plan/problem_size.hpp"

namespace stillpoint {

/// The reasons to find ω₁, and with it to factorise K.
struct Omega1Needs {
  bool critical_damping = false, tolerances = false, relaxation = false, distance = false;
  bool useful = false;  // ω₁ makes an answer better, and costs little
  bool any() const { return critical_damping || tolerances || relaxation || useful; }
};

/// An object that a run keeps in memory when it takes most.
struct MemoryPart {
  std::string what;
  double bytes = 0;
  std::string key;  // the key of the scene that sets its size
};

/// The properties of a model that a plan estimates, and that are known for certain once the model is made.
struct Estimates {
  double unknowns = 0;               // their number, estimated before supports take some away
  bool linear = false;               // whether Q = F − R is linear in u, and symmetric
  bool multigrid_serves = true;      // whether a multigrid mass can be made of K, and nothing lies free
  bool mass_measures_volume = true;  // whether ‖u‖_M measures u as well as ‖u‖_V; the inertia of multigrid does
};

struct Plan {
  MemoryRoom room;  // that the machine has
  BodySize size;
  MatrixSize stiffness;

  // The way to rest:
  const StrategyInfo* strategy = nullptr;           // the damping or relaxation that the problem names
  const StaticMethodInfo* static_method = nullptr;  // in the place of any motion; null: there is one
  const RelaxationInfo* relaxation = nullptr;       // in the place of the integrator's step; null: a damping

  bool remembers = false;         // whether some law, or friction, has a history
  bool nonlinear_law = false;     // whether some law is not linear
  bool nonlinear = false;         // whether some law is not, or contacts open and close
  bool moves_on = false;          // whether phases end
  bool equilibrium_only = false;  // whether only equilibrium is asked for, under loads that stay: then inertia is free,
                                  // and velocities may be reset
  bool chooses_mass = false;      // whether the relaxation finds its own mass, as auto does
  bool tries_scaled_mass = false;  // whether auto makes a phase with masses by Gershgorin's bound beside the physical
                                   // one

  // Decisions by the estimates, see revise():
  Estimates estimates;
  double multigrid_gain = 0;        // ratio of the times without and with multigrid; 0: auto leaves it aside
  bool multigrid = false;           // whether multigrid is the mass: asked for, or auto's choice
  bool steps_tell_omega_1 = false;  // whether the steps tell ω₁ of the motions that the loads drive
  Omega1Needs omega_1;
  bool factorises = false;  // whether K is factorised unless multigrid is the mass: by Newton's method, or for ω₁
  bool makes_factor() const { return factorises && !multigrid; }

  double bytes_per_point = 0;
  std::vector<MemoryPart> memory;  // the parts that are there at once, when most is
  double bytes() const;            // all of them together, beside what the program itself takes
};

/// Decides what is made for a problem, and how much memory that takes, to 30 % and without what is small. A factor that
/// only UMFPACK makes on the way is not in it.
Plan make_plan(const Problem& problem, const MemoryRoom& room = memory_room());

/// Decides again, by what is known for certain: the one place at which a plan is corrected.
void revise(const Problem& problem, const Estimates& found, Plan& plan);

/// Whether ‖u‖_M is as good a measure of u as ‖u‖_V; scaled: whether the mass is scaled by the stiffness.
bool mass_measures_volume(const Problem& problem, bool scaled);

/// Sets the bytes a point and the parts of memory of a plan whose decisions are made.
void plan_memory(const Problem& problem, Plan& plan);

/// Returns the plan. Throws SceneError at the key that sets the largest part if the process may not take so much
/// memory.
Plan require_memory(Plan plan);

}  // namespace stillpoint

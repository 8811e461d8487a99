// The state of a run: the model, the motion through the present phase, and what has been counted and measured so far.
// The loop advances it; watchers and records read it.
#pragma once

#include <stillpoint/simulation.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/stopwatch.hpp"
#include "simulation/giving_way.hpp"
#include "simulation/loads/load_schedule.hpp"
#include "simulation/measurements.hpp"
#include "simulation/phase_motion.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/verdict.hpp"

namespace stillpoint {

/// What a stage begins with.
struct StageBegin {
  double t = 0;                            // [s]
  int number = 0;                          // of stages before it
  std::shared_ptr<CarriedBody> carried{};  // what its points had been; null: it is the first stage
};

struct RunState {
  /// Sets the scene up; there is no motion yet. Throws as the constructor of Simulation does.
  RunState(Scene scene, SimulationOptions options);
  /// The next stage of a run: `begins` with what the stage before has handed on. That stage is of no more use.
  RunState(RunState& before, Scene scene, StageBegin begins);

  /// Begins the first phase, or the next one at rest in its own unknowns; v0: (n) [m/s].
  void begin_phase(ConstVec u0, ConstVec v0) { motion.emplace(model, scene, vectors, t, u0, v0); }
  void begin_next_phase(ConstVec v0);

  long steps() const { return earlier_steps + (motion ? motion->stepper->steps() : 0); }
  long evaluations() const { return earlier_evaluations + (motion ? motion->system.evaluations() : 0); }
  long rejected_steps() const { return earlier_rejected + (motion ? motion->stepper->rejected_steps() : 0); }
  double wall_s() const { return earlier_wall_s + wall.seconds(); }
  /// True if all that acts on the body is what it will be at the end, walls that are still on their way and multipliers
  /// of contact included.
  bool loads_settled() const;
  /// True if loads, supports, rigid bodies and what a stage lets come on are what they will be at the end of the stage.
  bool loads_stay() const;
  /// The question whether the run is to end, as a function; empty if the run heeds no such request while it is at work.
  std::function<bool()> asks_to_end();
  /// The same in work in which all ranks ask it as often after they have gathered.
  std::function<bool()> asks_all_to_end();
  std::function<bool()> asks_this_rank_to_end();
  /// The verdict that the run has failed now: "at t = 0.31 s, after 120 steps, in phase 3: " and what happened.
  Verdict failed(const std::string& what) const;

  /// Throws std::runtime_error if the ranks of the run do not all have the same motion.
  void check_that_ranks_agree() const;

  /// The velocities with which the next phase or stage begins, (n); a fictitious inertia has none that could go on.
  std::vector<double> velocity_to_hand_on() const;

  void archive(const StateArchive& state);

  Scene scene;  // in the present stage
  SimulationOptions options;
  EndRequest end_request;
  Stopwatch wall;
  VectorSpace vectors;
  StageBegin stage;
  Model model;
  LoadSchedule schedule;
  GivingWay giving_way;
  Measurements measured;
  std::optional<PhaseMotion> motion;  // through the present phase

  double t, step = 0;               // [s]
  double landing = 0;               // the time that no step passes: of the next row, of a stage, or of the end [s]
  bool is_cut = true;               // whether the last step is as short as it is to end at a time that was asked for
  double progress = 0;              // of the phase towards its end, which comes at 1
  int phases = 1, first_phase = 1;  // of all stages so far, and at which of them the present stage began
  long earlier_steps = 0, earlier_evaluations = 0, earlier_rejected = 0;  // in the phases before
  double stepping_s = 0, earlier_wall_s = 0;  // wall time of all steps, and of the runs that this one resumes [s]

  bool contact_settled = true;  // whether the multipliers of contact with rigid bodies are those of an equilibrium
  std::string waits_for;        // the condition beside the residual that equilibrium waits for; empty: none
  std::optional<double> load_growth;  // the growth of driven loads, as LimitLoad measures it

 private:
  Model set_up();
};

}  // namespace stillpoint

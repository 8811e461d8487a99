// One simulation of a scene, step by step: `stillpoint run` for programs.
//
//   Simulation simulation(load_scene("bar.toml"));
//   while (!simulation.done()) {
//     simulation.step();
//     … simulation.t(), simulation.field("stress") …
//   }
//   const Summary summary = simulation.summary();
#pragma once

#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/scene.hpp>
#include <stillpoint/summary.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

class Ranks;             // opaque: for the command
class Stepper;           // <stillpoint/stepper.hpp>
class SetUpStore;        // opaque: for the library's own studies
struct SimulationParts;  // opaque: for the library's own studies, tests and Python module

/// The progress of a simulation at work.
struct Progress {
  double t = 0, end_time = 0;  // [s]; end_time 0: open
  long steps = 0;
  double residual = 0, residual_goal = 0;  // residual_goal 0: no such test
  double wall_s = 0;
  std::string waits_for{};  // the condition other than the residual that equilibrium waits for; empty: none, or there
                            // is no such test
};

struct SimulationOptions {
  std::filesystem::path out{};  // folder for history.csv, the fields and checkpoints; empty: no files
  /// A checkpoint of the same scene to resume from, with the files in `out`; empty: from the start.
  std::filesystem::path resume{};
  int threads = 0;  // at most so many, 0: as many as OpenMP would take; one where that is quicker
  /// True: steps end at the times of rows and snapshots, which are recorded.
  bool records = true;
  /// True: the scene's stop tests end the simulation; otherwise only a failure does.
  bool stops = true;
  /// Asked after every step, and often while no step is taken: in the set-up, within Newton's method and in the tests
  /// at the end. True ends the run in good order.
  std::function<bool()> interrupted{};
  /// A user-defined stopping test, called after every accepted step beside those of the scene: returns why the
  /// simulation ends there, or an empty string if it goes on. It may inspect the Simulation.
  std::function<std::string()> stop_test{};
  /// Called with the names of the columns ("t", "steps", …) and each row of the history, with files or without.
  std::function<void(const std::vector<std::string>& columns, const std::vector<double>& row)> at_row{};
  std::function<void(const Progress&)> progress{};  // called a few times a second
  /// Called before a phase ends (false) and when the next has begun (true); the Simulation shows that state.
  std::function<void(bool begun)> at_phase_change{};
  /// A store of what simulations of one body share, if they differ only in damping, integrator and solver; it must
  /// outlive them. Null: each makes its own.
  SetUpStore* store = nullptr;
  /// The processes that run this simulation together, each of which makes a Simulation of the same scene. Null: this
  /// one alone.
  std::shared_ptr<const Ranks> ranks{};
};

/// Thrown if the set-up of a simulation was interrupted, or took longer than stop.wall_time; what() says which.
class SetUpStopped : public std::runtime_error {
 public:
  SetUpStopped(RunStatus status, const std::string& reason, double wall_s)
      : std::runtime_error(reason), status_(status), wall_s_(wall_s) {}
  RunStatus status() const { return status_; }  // interrupted or time_limit
  double wall_s() const { return wall_s_; }

 private:
  RunStatus status_;
  double wall_s_;
};

/// The scene of a checkpoint, from its text. Throws StateError, or SceneError if files that the text refers to have
/// changed.
Scene load_scene_of(const std::filesystem::path& checkpoint);

class Simulation {
 public:
  /// Sets the scene up at its start. Throws SceneError if that is impossible, or if `out` cannot be written; nothing is
  /// written then. Throws StateError if the checkpoint cannot be resumed: it is damaged, or of another scene, body or
  /// version. Throws SetUpStopped if the simulation has to end before it has begun; a factorisation that cannot be
  /// stopped may then go on in a thread of its own until it is done.
  explicit Simulation(Scene scene, SimulationOptions options = {});
  /// The same of a problem that a program has made or changed, which is resolved first.
  explicit Simulation(Problem problem, SimulationOptions options = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// One accepted step, not past t_stop [s], with the change of phase that it calls for. With a static solver a step is
  /// an iterate. Does nothing once done(). OpenMP's own number of threads is left unchanged.
  RunStatus step(double t_stop = std::numeric_limits<double>::infinity());
  /// Steps until t, or until the simulation is done.
  RunStatus run_until(double t);
  /// Steps until the simulation is done.
  RunStatus run() { return run_until(std::numeric_limits<double>::infinity()); }
  bool done() const;
  RunStatus status() const;
  const std::string& reason() const;  // the inequality that ended the simulation, or what failed

  double t() const;    // [s]
  ConstVec u() const;  // nodal displacement since the phase began, (n) [m]; valid until the next step
  ConstVec v() const;  // nodal velocity, (n) [m/s]; valid until the next step
  /// The state y = [u; v] of the present phase, (2n), which steps advance in place; [u; p] if
  /// system().keeps_momentum(). The pointer keeps the memory alive: after a change of phase, or after this object, the
  /// state stays as it was then.
  std::shared_ptr<const Vector> state() const;
  long steps() const;
  long evaluations() const;  // evaluations of the internal force by the integrator
  int phases() const;
  std::size_t points() const;  // P
  double residual();           // ‖F − R‖/‖F‖ of the present state
  /// A field at the material points, row by row: "position", "u", "v" (P × dim), "strain", "stress" (P × components),
  /// "plastic_strain" … (P); valid until the next call. Throws std::invalid_argument for another name.
  ConstVec field(std::string_view name);

  /// Saves the state between two steps, to be resumed by options.resume: the same steps follow, bit for bit, except
  /// where Method::begins_anew. Throws std::filesystem::filesystem_error.
  void save(const std::filesystem::path& checkpoint);

  /// The results up to now; complete once done().
  Summary summary();

  /// The parts of the simulation, for programs that inspect them; each is valid until the phase changes.
  RelaxationSystem& system();
  const Stepper& stepper() const;
  SimulationParts parts() const;
  /// The bound on the error ‖u − u*‖/‖u‖ at present, after residual(); empty if there is none.
  std::optional<double> distance();
  /// True if the loads have reached their final values.
  bool loads_settled() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stillpoint

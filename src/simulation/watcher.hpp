// A watcher looks at a run after its steps, and says when it is over. The loop asks all watchers in the order of one
// list, and knows none of them by name: a watcher is a file of simulation/watch/ and a row of
// simulation/watch/watchers.cpp.
#pragma once

#include <stillpoint/state_archive.hpp>
#include <stillpoint/summary.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/run_state.hpp"

namespace stillpoint {

class Watcher {
 public:
  virtual ~Watcher() = default;

  /// At the beginning and after each accepted step: takes a sample, if one is due.
  virtual void observe(RunState&) {}
  /// After all have observed a step, unless options.stops is off: whether the run is over. The first watcher that ends
  /// it is the last one that is asked.
  virtual Verdict judge(RunState&) { return {}; }
  /// After a state has been recorded from which the run goes on: changes what the next step begins with.
  virtual void go_on(RunState&) {}
  /// Before a phase ends. is_last: the run ends with it.
  virtual void end_phase(RunState&, bool is_last) { static_cast<void>(is_last); }
  /// When the next phase has begun: whether the run is over.
  virtual Verdict begin_phase(RunState&) { return {}; }

  /// After a limit has ended the run before it was at rest, or a point was lost, or a static solver has given up
  /// (status failed): adds to the reason what still moves, or what may be done.
  virtual void explain(RunState&, Verdict&) {}
  /// While the run claims equilibrium at its end: adds a doubt to the reason, or takes the claim back.
  virtual void confirm(RunState&, Verdict&) {}
  /// Adds figures and notes to a summary: first those of the way so far, then those of the present state, if that can
  /// be evaluated.
  virtual void fill(Summary&, const RunState&) {}
  virtual void fill_state(Summary&, RunState&) {}

  /// Saves or restores what the watcher has seen.
  virtual void archive(const StateArchive&, RunState&) {}
  /// Saves what it has seen that no later stage mends, or restores that in the watcher of the next stage, which has
  /// seen nothing else.
  virtual void archive_for_next_stage(const StateArchive&) {}
};

/// Adds a note to a summary; one that is empty adds nothing.
inline void add_note(Summary& summary, const std::optional<std::string>& note) {
  if (note && !note->empty()) summary.notes.push_back(*note);
}

/// A watcher, and the name of its part of a checkpoint.
struct Watched {
  std::string name;
  std::unique_ptr<Watcher> watcher;
};

/// All watchers of a run, which outlives them, in the order in which they are asked.
std::vector<Watched> make_watchers(RunState& run);

// Those that nobody but the list knows, each from a file of its own:
std::unique_ptr<Watcher> watch_single_phase();
std::unique_ptr<Watcher> watch_left_in_points();
std::unique_ptr<Watcher> watch_passed_bodies();
std::unique_ptr<Watcher> watch_sudden_bodies(const RunState& run);
std::unique_ptr<Watcher> watch_hooked_corners();
std::unique_ptr<Watcher> watch_coarse_contact();
std::unique_ptr<Watcher> watch_unheld_bodies();
std::unique_ptr<Watcher> watch_rate_share(const RunState& run);
std::unique_ptr<Watcher> watch_multipliers(RunState& run);
std::unique_ptr<Watcher> watch_plastic_path(const RunState& run);

}  // namespace stillpoint

// The records of a run: rows of history.csv, snapshots of all fields, and the energy balance that goes with them.
#pragma once

#include <stillpoint/simulation.hpp>

#include <string>
#include <vector>

#include "output/history.hpp"
#include "output/probes.hpp"
#include "output/snapshots.hpp"
#include "simulation/energy_balance.hpp"
#include "simulation/run_state.hpp"

namespace stillpoint {

class Recorder {
 public:
  /// Opens the files of the run, which outlives this object; without a folder there are none. Throws SceneError if the
  /// folder cannot be written. resumed: the run goes on with files that are there, which archive() opens.
  Recorder(RunState& run, bool resumed);
  void archive(const StateArchive& state);

  /// Saves what the records of the next stage go on with, after end_phase().
  void end_stage(const StateArchive& state);
  /// Goes on with the records of the stage before, as it saved them, at the begin of a stage; work: as external_work().
  void go_on(const StateArchive& state, RunState& run, double work);
  double external_work() const { return energy_balance_.external_work(); }  // [J]

  /// The next time that a step must not pass [s].
  double next_time() const;
  /// After an accepted step: takes a row and a snapshot if they are due; last: a row in any case.
  void sample(RunState& run, bool last);

  /// Before a phase ends, and when the next has begun.
  void end_phase(RunState& run);
  void begin_phase(RunState& run);
  /// Closes the files; a run that ends writes its last state as well, if it can be read.
  void finish(double t, const PhaseMotion* motion);
  void fill(Summary& summary, RunState& run);

 private:
  void archive_files(const StateArchive& state);
  double next_row_time() const;
  void add_row(RunState& run);
  std::vector<std::string> columns() const;
  void tell(const HistoryRow& figures, const std::vector<double>& others) const;

  const Problem& problem_;
  const LagrangianPhase& phase_;
  const SimulationOptions& options_;
  bool has_distance_;  // whether rows have a column for the distance
  Probes probes_;
  double largest_factor_ = 0;  // the largest factor of driven loads in the rows
  EnergyBalance energy_balance_;
  History history_;
  Snapshots snapshots_;
  double interval_;       // between rows [s]
  bool lands_on_rows_;    // false: a row is taken at the first step that is not before its time
  long rows_ = 0;         // number of the next row: it is due at rows_ · interval_
  double last_row_ = -1;  // the time of the last row [s]
};

}  // namespace stillpoint

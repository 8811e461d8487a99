// What a simulation leaves behind on its way: rows of history.csv, snapshots of all fields, and the energy balance that
// goes with them.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/history.hpp"
#include "output/probes.hpp"
#include "output/snapshots.hpp"
#include "simulation/energy_balance.hpp"
#include "simulation/phase_motion.hpp"
#include "simulation/setup/model.hpp"

namespace stillpoint {

class Recorder {
 public:
  /// has_distance: whether rows have a column for the error bound. Throws SceneError if the folder cannot be written;
  /// an empty one: no files. resumed: the run goes on with files that are there, which archive() opens. The scene and
  /// the model outlive this.
  Recorder(const Problem& problem, const Model& model, const std::filesystem::path& folder, bool has_distance,
           bool resumed);
  void archive(const StateArchive& state);
  /// Each row from now on, with the names of its columns.
  using Told = std::function<void(const std::vector<std::string>& columns, const std::vector<double>& row)>;
  void tell_rows(Told told) { told_ = std::move(told); }

  /// The next time that a step must not pass [s].
  double next_time() const;
  /// After an accepted step: takes a row and a snapshot if they are due; last: a row in any case. evaluate fills the
  /// row but for its probes.
  template <class Evaluate>
  void sample(double t, PhaseMotion& motion, bool last, const Evaluate& evaluate) {
    if ((last && t != last_row_) || t >= next_row_time()) add_row(evaluate(), motion);
    snapshots_.sample(t, motion.u(), motion.v());
  }
  /// A row of now.
  struct Row {
    HistoryRow figures;
    std::optional<double> distance;
  };
  void add_row(const Row& row, PhaseMotion& motion);

  /// Before a phase ends, and when the next has begun.
  void end_phase(double t, PhaseMotion& motion);
  void begin_phase(double t, PhaseMotion& motion);
  /// Closes the files; a run that ends writes its last state as well, if it can be read.
  void finish(double t, const PhaseMotion* motion);
  void fill(Summary& summary, double t, PhaseMotion& motion);

 private:
  double next_row_time() const;
  std::vector<std::string> columns() const;
  void tell(const HistoryRow& figures, const std::vector<double>& others) const;

  const Problem& problem_;
  const LagrangianPhase& phase_;
  bool has_distance_;
  Probes probes_;
  double largest_factor_ = 0;  // of driven loads, in the rows
  EnergyBalance energy_balance_;
  History history_;
  Told told_;
  Snapshots snapshots_;
  double interval_;       // between rows [s]
  bool lands_on_rows_;    // else a row is taken at the first step that is not before it
  long rows_ = 0;         // number of the next row: it is due at rows_ · interval_
  double last_row_ = -1;  // [s]
};

}  // namespace stillpoint

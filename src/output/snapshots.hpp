// The moments of a run at which all fields are written.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/summary.hpp>

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "output/field_writer.hpp"
#include "output/vtu_writer.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Whether the fields of all points are written at some times in files of a format, "xdmf" or "vtu".
bool writes_fields(const OutputSpec& output, std::string_view format);

/// Writes at the times of output.snapshots and every output.fields_every, and the last state when the run ends.
class Snapshots {
 public:
  /// Nothing is written if the scene asks for no fields or the folder is empty, but slope angles are recorded all the
  /// same. gathers: whether the fields that the scene asks for are gathered, as all ranks have to for the one that has
  /// a folder. resumed: the files exist, and archive() opens them.
  Snapshots(const Problem& problem, const LagrangianPhase& phase, bool gathers, const std::filesystem::path& folder,
            bool resumed = false);
  void archive(const StateArchive& state);

  /// The next time that a step must not pass [s]; infinite if there is none.
  double next_time() const;
  /// Writes the state at (t, u, v) if it is due.
  void sample(double t, ConstVec u, ConstVec v);
  /// Writes the state in which the run ends, if the scene asks for fields.
  void take_last(double t, ConstVec u, ConstVec v);
  /// Closes the files.
  void finish();

  const std::vector<Snapshot>& taken() const { return taken_; }

 private:
  void take(double t, ConstVec u, ConstVec v);
  /// Opens the files; frames: those of a run that is continued.
  void open(std::size_t frames);

  const Problem& problem_;
  const LagrangianPhase& phase_;
  bool gathers_;
  std::filesystem::path folder_;  // empty: nothing is written
  std::optional<FieldWriter> xdmf_;
  std::optional<VtuWriter> vtu_;
  std::size_t frames_ = 0;  // that were written
  std::size_t next_snapshot_ = 0;
  long next_regular_ = 0;
  std::vector<Snapshot> taken_;
};

/// The angle of the free surface of the points at (t, u), in a plane scene [degrees]; NaN if there is no slope.
double slope_angle_of(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u);
/// The same angle from the positions of points along x and y, in columns as wide as a cell; position: (points × 2) [m].
double slope_angle_of(const Problem& problem, ConstVec position);

}  // namespace stillpoint

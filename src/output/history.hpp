// history.csv: a row per output time, and the probes in it.
#pragma once

#include <stillpoint/scene.hpp>
#include <stillpoint/state_archive.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/atomic_file.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// The columns of a row that are not probes.
struct HistoryRow {
  double t;
  long steps, rhs_evaluations;
  double residual, kinetic_energy;
};

/// Looks at what the scene's probes ask for: fields at material points, and the forces on its walls.
class Probes {
 public:
  Probes(const Scene& scene, const LagrangianPhase& phase);

  const std::vector<std::string>& columns() const { return columns_; }  // "<probe>.<field>"
  const std::vector<ProbeSpec>& specs() const { return specs_; }
  /// Where probe k's material point was when the run began, (dim) [m]; empty for a probe of another kind.
  const std::vector<double>& position(std::size_t k) const { return position_[k]; }
  /// Values at (t, u, v), in the order of columns(); the state is that of the last commit.
  std::vector<double> read(double t, ConstVec u, ConstVec v);

 private:
  struct Source {
    std::string field;  // as point_field() knows it
    std::size_t component;
    std::size_t components;  // 0: the angle of the slope
    std::size_t point;
  };

  const Scene& scene_;
  const LagrangianPhase& phase_;
  std::vector<ProbeSpec> specs_;
  std::vector<std::vector<double>> position_;
  std::vector<std::string> columns_;
  std::vector<Source> sources_;  // of the first columns
};

class History {
 public:
  /// An empty folder: rows are not written. resumed: archive() opens the file, which is there.
  History(const std::filesystem::path& folder, const std::vector<std::string>& probe_columns, bool resumed = false);
  /// Restoring takes away what rows came after.
  void archive(const StateArchive& state);
  void add(const HistoryRow& row, const std::vector<double>& probes);
  void finish();

 private:
  std::filesystem::path path_;
  std::optional<AtomicFile> file_;
};

}  // namespace stillpoint

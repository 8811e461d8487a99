// history.csv: a row per output time, and the probes in it.
#pragma once

#include <stillpoint/lagrangian_phase.hpp>
#include <stillpoint/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atomic_file.hpp"

namespace stillpoint {

/// The columns of a row that are not probes.
struct HistoryRow {
  double t;
  long steps, rhs_evaluations;
  double residual, kinetic_energy;
};

/// Looks at the scene's probes in a phase.
class Probes {
 public:
  Probes(const Scene& scene, const LagrangianPhase& phase);

  const std::vector<std::string>& columns() const { return columns_; }  // "<probe>.<field>"
  const std::vector<ProbeSpec>& specs() const { return specs_; }
  /// Where probe k's material point was when the phase began, (dim) [m].
  std::vector<double> place(std::size_t k) const { return phase_.place(point_[k]); }
  /// Values at (t, u, v), in the order of columns(); commits nothing: stress is that of the last commit.
  std::vector<double> read(double t, ConstVec u, ConstVec v);

 private:
  const LagrangianPhase& phase_;
  std::vector<ProbeSpec> specs_;
  std::vector<std::size_t> point_;  // of each probe
  std::vector<std::string> columns_;
  std::vector<double> displacement_, velocity_, strain_;  // at all points; empty where no probe asks
};

class History {
 public:
  /// An empty folder: rows are not written.
  History(const std::filesystem::path& folder, const std::vector<std::string>& probe_columns);
  void add(const HistoryRow& row, const std::vector<double>& probes);
  void finish();

 private:
  std::optional<AtomicFile> file_;
};

}  // namespace stillpoint

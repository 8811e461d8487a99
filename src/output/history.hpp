// history.csv: a row per output time.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/atomic_file.hpp"

namespace stillpoint {

/// The columns of a row that are not probes.
struct HistoryRow {
  double t;
  long steps, rhs_evaluations;
  double residual, kinetic_energy;
};

class History {
 public:
  /// folder: empty if no rows are to be written. resumed: the file exists, and archive() opens it.
  History(const std::filesystem::path& folder, const std::vector<std::string>& probe_columns, bool resumed = false);
  /// Restoring removes the rows that were written after the archived state.
  void archive(const StateArchive& state);
  void add(const HistoryRow& row, const std::vector<double>& probes);
  void finish();

 private:
  std::filesystem::path path_;
  std::optional<AtomicFile> file_;
};

}  // namespace stillpoint

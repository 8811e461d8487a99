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

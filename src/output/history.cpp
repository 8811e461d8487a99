#include "output/history.hpp"

#include <iterator>

#include <fmt/format.h>

namespace stillpoint {
History::History(const std::filesystem::path& folder, const std::vector<std::string>& probe_columns, bool resumed) {
  if (folder.empty()) return;
  path_ = folder / "history.csv";
  if (resumed) return;
  file_.emplace(path_);
  std::string header = "t,steps,rhs_evaluations,residual,kinetic_energy";
  for (const std::string& column : probe_columns) header += "," + column;
  file_->write(header + "\n");
}

void History::add(const HistoryRow& row, const std::vector<double>& probes) {
  if (!file_) return;
  // 17 significant digits restore every double exactly
  std::string line = fmt::format("{:.17g},{},{},{:.17g},{:.17g}", row.t, row.steps, row.rhs_evaluations, row.residual,
                                 row.kinetic_energy);
  for (const double value : probes) fmt::format_to(std::back_inserter(line), ",{:.17g}", value);
  file_->write(line + "\n");
}

void History::archive(const StateArchive& state) {
  if (path_.empty()) return;
  FileContents written = file_ ? file_->contents() : FileContents();
  state("bytes", written.size);
  state("crc", written.crc);
  if (state.restores()) file_.emplace(path_, written);
}

void History::finish() {
  if (file_) file_->finish();
}

}  // namespace stillpoint

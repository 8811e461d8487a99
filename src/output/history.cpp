#include "output/history.hpp"

#include <iterator>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "output/nearest_position.hpp"
#include "output/point_fields.hpp"
#include "output/snapshots.hpp"

namespace stillpoint {
Probes::Probes(const Scene& scene, const LagrangianPhase& phase) : scene_(scene), phase_(phase), specs_(scene.probes) {
  const std::vector<double> positions = phase.positions();
  const auto dim = static_cast<std::size_t>(phase.dim());
  std::optional<NearestPosition> nearest;  // made if a probe asks for it
  for (const ProbeSpec& probe : specs_) {
    if (probe.kind == ProbeKind::slope_angle) {
      position_.emplace_back();
      columns_.push_back(probe.name + ".slope_angle");
      sources_.push_back({"slope_angle", 0, 0, 0});
      continue;
    }
    if (!probe.point && !nearest) nearest.emplace(positions, dim);
    const std::size_t point = probe.point ? static_cast<std::size_t>(*probe.point - 1) : nearest->to(probe.at);
    position_.emplace_back(positions.begin() + static_cast<std::ptrdiff_t>(dim * point),
                           positions.begin() + static_cast<std::ptrdiff_t>(dim * (point + 1)));
    for (const std::string& field : probe.fields) {
      columns_.push_back(probe.name + "." + field);
      const auto [name, component, components] = find_point_field(phase, field);
      sources_.push_back({name, component, components, point});
    }
  }
  for (const WallReaction& wall : phase.wall_reactions(0)) {
    columns_.push_back(wall.name + ".normal");
    columns_.push_back(wall.name + ".shear");
  }
}

std::vector<double> Probes::read(double t, ConstVec u, ConstVec v) {
  std::map<std::string, std::vector<double>> fields;  // each asked for once
  std::optional<double> slope_angle;
  std::vector<double> values;
  for (const Source& source : sources_) {
    if (source.components == 0) {
      if (!slope_angle) slope_angle = slope_angle_of(scene_, phase_, t, u);
      values.push_back(*slope_angle);
      continue;
    }
    auto [field, missing] = fields.try_emplace(source.field);
    if (missing) field->second = point_field(phase_, source.field, t, u, v);
    values.push_back(field->second[source.components * source.point + source.component]);
  }
  for (const WallReaction& wall : phase_.wall_reactions(t)) {
    values.push_back(wall.normal);
    values.push_back(wall.shear);
  }
  return values;
}

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
  // 17 significant digits bring every double back
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

#include "history.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include <fmt/format.h>

namespace stillpoint {
namespace {

std::size_t nearest_point(const LagrangianPhase& phase, const std::vector<double>& at) {
  std::size_t best = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < phase.points(); ++p) {
    const std::vector<double> x = phase.place(p);
    double square = 0;
    for (std::size_t d = 0; d < x.size(); ++d) square += (x[d] - at[d]) * (x[d] - at[d]);
    if (square < smallest) smallest = square, best = p;
  }
  return best;
}

}  // namespace

Probes::Probes(const Scene& scene, const LagrangianPhase& phase) : phase_(phase), specs_(scene.probes) {
  assert(phase.dim() == 1);  // a field of one component a column; make_model() has checked the numbers of points
  for (const ProbeSpec& probe : specs_) {
    point_.push_back(probe.point ? static_cast<std::size_t>(*probe.point - 1) : nearest_point(phase, probe.at));
    for (const std::string& field : probe.fields) {
      columns_.push_back(probe.name + "." + field);
      if (field == "u") displacement_.resize(phase.points());
      if (field == "v") velocity_.resize(phase.points());
      if (field == "strain") strain_.resize(phase.points());
    }
  }
}

std::vector<double> Probes::read(double t, ConstVec u, ConstVec v) {
  if (!displacement_.empty()) phase_.point_displacement(t, u, displacement_);
  if (!velocity_.empty()) phase_.point_velocity(t, v, velocity_);
  if (!strain_.empty()) phase_.point_strain(t, u, strain_);
  std::vector<double> values;
  for (std::size_t k = 0; k < specs_.size(); ++k) {
    for (const std::string& field : specs_[k].fields) {
      const ConstVec source = field == "u"        ? ConstVec(displacement_)
                              : field == "v"      ? ConstVec(velocity_)
                              : field == "strain" ? ConstVec(strain_)
                                                  : phase_.point_stress();
      values.push_back(source[point_[k]]);
    }
  }
  return values;
}

History::History(const std::filesystem::path& folder, const std::vector<std::string>& probe_columns) {
  if (folder.empty()) return;
  file_.emplace(folder / "history.csv");
  std::string header = "t,steps,rhs_evaluations,residual,kinetic_energy";
  for (const std::string& column : probe_columns) header += "," + column;
  file_->write(header + "\n");
}

void History::add(const HistoryRow& row, const std::vector<double>& probes) {
  if (!file_) return;
  // 17 significant digits bring every double back
  std::string line = fmt::format("{:.17g},{},{},{:.17g},{:.17g}", row.t, row.steps, row.rhs_evaluations, row.residual,
                                 row.kinetic_energy);
  for (const double value : probes) line += fmt::format(",{:.17g}", value);
  file_->write(line + "\n");
}

void History::finish() {
  if (file_) file_->finish();
}

}  // namespace stillpoint

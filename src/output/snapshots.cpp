#include "output/snapshots.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "output/free_surface.hpp"
#include "output/point_fields.hpp"
#include "scene/dimensions.hpp"
#include "scene/grid_lines.hpp"

namespace stillpoint {

bool writes_fields(const OutputSpec& output, std::string_view format) {
  return (!output.snapshots.empty() || output.fields_every > 0) &&
         std::ranges::find(output.format, format) != output.format.end();
}

double slope_angle_of(const Problem& problem, ConstVec position) {
  const double column = longest_cell(problem.grid, 0);
  double base = std::numeric_limits<double>::infinity();
  for (const BodySpec& body : problem.bodies)
    base = std::min(base, body.min.empty() ? problem.grid.min[1] : body.min[1]);
  return slope_angle(free_surface(position, column), base);
}

double slope_angle_of(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  if (!dimension_info(phase.dim()).is_section) return std::numeric_limits<double>::quiet_NaN();
  return slope_angle_of(problem, current_positions(phase, t, u));
}

namespace {

std::string unit_of(const std::string& field) {
  constexpr std::array<std::array<std::string_view, 2>, 6> units{
      {{"u", "m"}, {"v", "m/s"}, {"stress", "Pa"}, {"volume", "m^3"}, {"pore_pressure", "Pa"}, {"pc", "Pa"}}};
  const auto found = std::ranges::find(units, field, [](const auto& one) { return one[0]; });
  return found == units.end() ? "" : std::string((*found)[1]);
}

FieldFrame frame_at(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, ConstVec v) {
  FieldFrame frame{.t = t,
                   .dim = phase.dim(),
                   .points = phase.points(),
                   .position = current_positions(phase, t, u),
                   .fields = {},
                   .material = phase.fields().point_data().materials,
                   .grid_lines = phase.shape().grid_lines()};
  const auto add = [&](const std::string& name, std::vector<double> values) {
    const int components = static_cast<int>(values.size() / phase.points());
    frame.fields.push_back({name, components, std::move(values), unit_of(name)});
  };
  for (const char* name : {"u", "v", "stress", "volume"}) add(name, point_field(phase, name, t, u, v));
  if (!problem.phase.ends()) add("strain", strain_tensors(phase, t, u));
  for (const std::string& name : phase.info().law_fields) add(name, point_field(phase, name, t, u, v));
  return frame;
}

}  // namespace

Snapshots::Snapshots(const Problem& problem, const LagrangianPhase& phase, bool gathers,
                     const std::filesystem::path& folder, bool resumed)
    : problem_(problem),
      phase_(phase),
      gathers_(gathers && (writes_fields(problem.output, "xdmf") || writes_fields(problem.output, "vtu"))) {
  if (gathers_) folder_ = folder;
  if (!folder_.empty() && !resumed) open(0);
}

void Snapshots::open(std::size_t frames) {
  if (writes_fields(problem_.output, "xdmf")) xdmf_.emplace(folder_, frames);
  if (writes_fields(problem_.output, "vtu")) vtu_.emplace(folder_, frames);
}

void Snapshots::archive(const StateArchive& state) {
  state("frames", frames_);
  state("next_stage", next_snapshot_);
  state("next_regular", next_regular_);
  std::vector<double> times, angles;
  for (const Snapshot& one : taken_) {
    times.push_back(one.t);
    angles.push_back(one.slope_angle);
  }
  state("times", times);
  state("slope_angles", angles);
  if (!state.restores()) return;
  if (times.size() != angles.size()) throw StateError("the times of its stages and their angles differ in number");
  taken_.clear();
  for (std::size_t k = 0; k < times.size(); ++k) taken_.push_back({times[k], angles[k]});
  if (!folder_.empty()) open(frames_);
}

double Snapshots::next_time() const {
  double next = std::numeric_limits<double>::infinity();
  if (next_snapshot_ < problem_.output.snapshots.size()) next = problem_.output.snapshots[next_snapshot_];
  if (problem_.output.fields_every > 0) {
    next = std::min(next, static_cast<double>(next_regular_) * problem_.output.fields_every);
  }
  return next;
}

void Snapshots::sample(double t, ConstVec u, ConstVec v) {
  if (t < next_time()) return;
  while (next_snapshot_ < problem_.output.snapshots.size() && problem_.output.snapshots[next_snapshot_] <= t)
    ++next_snapshot_;
  while (problem_.output.fields_every > 0 && static_cast<double>(next_regular_) * problem_.output.fields_every <= t) {
    ++next_regular_;
  }
  take(t, u, v);
}

void Snapshots::take_last(double t, ConstVec u, ConstVec v) {
  if (gathers_ && (taken_.empty() || taken_.back().t < t)) take(t, u, v);
}

void Snapshots::finish() {
  if (xdmf_) xdmf_->finish();
}

void Snapshots::take(double t, ConstVec u, ConstVec v) {
  taken_.push_back({t, slope_angle_of(problem_, phase_, t, u)});
  if (!gathers_) return;
  const FieldFrame frame = frame_at(problem_, phase_, t, u, v);
  if (xdmf_) xdmf_->add(frame);
  if (vtu_) vtu_->add(frame);
  ++frames_;
}

}  // namespace stillpoint

#include "output/snapshots.hpp"

#include <algorithm>
#include <limits>

#include "output/free_surface.hpp"
#include "output/point_fields.hpp"
#include "scene/dimensions.hpp"
#include "scene/grid_lines.hpp"

namespace stillpoint {

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

Snapshots::Snapshots(const Problem& problem, const LagrangianPhase& phase, const std::filesystem::path& folder,
                     bool resumed)
    : problem_(problem), phase_(phase) {
  const bool asked = !problem.output.snapshots.empty() || problem.output.fields_every > 0;
  if (asked) folder_ = folder;
  if (!folder_.empty() && !resumed) writer_.emplace(folder_);
}

void Snapshots::archive(const StateArchive& state) {
  std::size_t frames = writer_ ? writer_->frames() : 0;
  state("frames", frames);
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
  if (!folder_.empty()) writer_.emplace(folder_, frames);
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
  if (writer_ && (taken_.empty() || taken_.back().t < t)) take(t, u, v);
}

void Snapshots::finish() {
  if (writer_) writer_->finish();
}

void Snapshots::take(double t, ConstVec u, ConstVec v) {
  taken_.push_back({t, slope_angle_of(problem_, phase_, t, u)});
  if (!writer_) return;
  FieldFrame frame{.t = t,
                   .dim = phase_.dim(),
                   .points = phase_.points(),
                   .position = current_positions(phase_, t, u),
                   .fields = {},
                   .material = phase_.fields().point_data().materials};
  std::vector<std::string> names = {"u", "v", "stress"};
  std::ranges::copy(phase_.info().history_names, std::back_inserter(names));
  for (const std::string& name : names) {
    std::vector<double> values = point_field(phase_, name, t, u, v);
    const int components = static_cast<int>(values.size() / phase_.points());
    frame.fields.push_back({name, components, std::move(values)});
  }
  writer_->add(frame);
}

}  // namespace stillpoint

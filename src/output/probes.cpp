#include "output/probes.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "output/snapshots.hpp"
#include "scene/dimensions.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

/// Reads fields of a material point.
class PointProbe final : public Probe {
 public:
  PointProbe(const LagrangianPhase& phase, const PointData& data, const ProbeSpec& spec)
      : point_(static_cast<std::size_t>(*spec.point - 1)) {
    for (const std::string& name : spec.fields) fields_.push_back(find_point_field(phase, name));
    const auto dim = static_cast<std::size_t>(phase.dim());
    const auto first = data.initial_positions.begin() + static_cast<std::ptrdiff_t>(dim * point_);
    position_.assign(first, first + static_cast<std::ptrdiff_t>(dim));
  }
  void read(ProbedMoment& moment, std::vector<double>& values) override {
    for (const PointFieldComponent& field : fields_)
      values.push_back(moment.field(field.name)[field.components * point_ + field.component]);
  }
  std::vector<double> position() const override { return position_; }

 private:
  std::vector<PointFieldComponent> fields_;
  std::size_t point_;
  std::vector<double> position_;
};

class SlopeAngle final : public Probe {
 public:
  void read(ProbedMoment& moment, std::vector<double>& values) override { values.push_back(moment.slope_angle()); }
};

/// The slope angle in space, of the points that lie in a box, seen along z.
class SlopeAngleInBox final : public Probe {
 public:
  SlopeAngleInBox(const Problem& problem, const ProbeSpec& spec) : problem_(problem), spec_(spec) {}
  void read(ProbedMoment& moment, std::vector<double>& values) override {
    const std::vector<double>& x = moment.field("position");
    std::vector<double> section;
    for (std::size_t p = 0; p < x.size(); p += 3) {
      if (is_inside(x.data() + p)) section.insert(section.end(), {x[p], x[p + 1]});
    }
    values.push_back(slope_angle_of(problem_, section));
  }

 private:
  bool is_inside(const double* x) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (!(x[d] >= spec_.min[d] && x[d] <= spec_.max[d])) return false;
    return true;
  }

  const Problem& problem_;
  const ProbeSpec& spec_;
};

std::unique_ptr<Probe> make_probe(const Problem& problem, const LagrangianPhase& phase, const PointData& data,
                                  const ProbeSpec& spec) {
  switch (spec.kind) {
    case ProbeKind::slope_angle:
      if (!spec.min.empty()) return std::make_unique<SlopeAngleInBox>(problem, spec);
      return std::make_unique<SlopeAngle>();
    case ProbeKind::mean:
      return mean_in_box(phase, data, spec);
    case ProbeKind::body:
      return body_sums(data, spec);
    case ProbeKind::point:
      break;
  }
  if (spec.point) return std::make_unique<PointProbe>(phase, data, spec);
  if (spec.frame == ProbeFrame::material) return moving_place(phase, spec, problem.phase.at_stages);
  return fixed_place(phase, spec);
}

/// ".shear", and in space ".shear.y" and ".shear.z" for a wall across x.
std::vector<std::string> shear_components(const WallReaction& wall, int dim) {
  std::vector<std::string> along = axis_names(dim);
  if (along.size() > 1) along.erase(along.begin() + wall.axis);  // a wall at the end of a line has a shear as well: 0
  return component_names(".shear", along);
}

/// Throws SceneError if a field of the probe exists in no law of the scene's materials.
void require_fields(const Problem& problem, const LagrangianPhase& phase, std::size_t number) {
  const ProbeSpec& probe = problem.probes[number];
  for (std::size_t f = 0; f < probe.fields.size() && probe.kind != ProbeKind::body; ++f) {
    const std::string name = find_point_field(phase, probe.fields[f]).name;
    if (is_field(phase, name)) continue;
    throw_scene_error(fmt::format("probe[{}].fields[{}]", number, f),
                      fmt::format("no law of these materials remembers '{}'", name));
  }
}

}  // namespace

const std::vector<double>& ProbedMoment::field(const std::string& name) {
  const auto [field, missing] = fields_.try_emplace(name);
  if (missing)
    field->second = name == "position" ? current_positions(phase_, t_, u_) : point_field(phase_, name, t_, u_, v_);
  return field->second;
}

const PlaceReader& ProbedMoment::places() {
  if (!places_) places_ = phase_.fields().read_places(t_, u_, v_);
  return *places_;
}

double ProbedMoment::slope_angle() {
  if (!slope_angle_) slope_angle_ = slope_angle_of(problem_, phase_, t_, u_);
  return *slope_angle_;
}

Probes::Probes(const Problem& problem, const LagrangianPhase& phase) : problem_(problem), phase_(phase) {
  const PointData data = problem.probes.empty() ? PointData() : phase.fields().point_data();
  for (std::size_t k = 0; k < problem.probes.size(); ++k) {
    const ProbeSpec& spec = problem.probes[k];
    if (!problem.phase.at_stages) require_fields(problem, phase, k);  // another stage may have other laws
    probes_.push_back(make_probe(problem, phase, data, spec));
    if (spec.kind == ProbeKind::slope_angle) columns_.push_back(spec.name + ".slope_angle");
    for (const std::string& field : spec.fields) columns_.push_back(spec.name + "." + field);
  }
  for (const WallReaction& wall : phase.supports().wall_reactions(0)) {
    columns_.push_back(wall.name + ".normal");
    for (const std::string& component : shear_components(wall, phase.dim())) columns_.push_back(wall.name + component);
  }
}

std::map<std::string, std::vector<double>> Probes::positions() const {
  std::map<std::string, std::vector<double>> positions;
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    if (auto x = probes_[k]->position(); !x.empty()) positions[problem_.probes[k].name] = std::move(x);
  }
  return positions;
}

std::vector<double> Probes::read(double t, ConstVec u, ConstVec v) {
  ProbedMoment moment(problem_, phase_, t, u, v);
  std::vector<double> values;
  for (const auto& probe : probes_) probe->read(moment, values);
  for (const WallReaction& wall : phase_.supports().wall_reactions(t)) {
    values.push_back(wall.normal);
    const std::size_t components = shear_components(wall, phase_.dim()).size();
    values.insert(values.end(), wall.shear.begin(), wall.shear.begin() + static_cast<std::ptrdiff_t>(components));
  }
  return values;
}

void Probes::end_phase(double t, ConstVec u, ConstVec v) {
  ProbedMoment moment(problem_, phase_, t, u, v);
  for (const auto& probe : probes_) probe->end_phase(moment);
}

void Probes::begin_phase(double t, ConstVec u, ConstVec v) {
  ProbedMoment moment(problem_, phase_, t, u, v);
  for (const auto& probe : probes_) probe->begin_phase(moment);
}

void Probes::end_stage() {
  for (const auto& probe : probes_) probe->end_stage();
}

void Probes::begin_stage(double t, ConstVec u, ConstVec v) {
  ProbedMoment moment(problem_, phase_, t, u, v);
  for (const auto& probe : probes_) probe->begin_stage(moment);
}

void Probes::archive(const StateArchive& state) {
  for (std::size_t k = 0; k < probes_.size(); ++k) probes_[k]->archive(state.part(fmt::format("{}", k)));
}

std::vector<std::string> Probes::notes() const {
  std::vector<std::string> notes;
  for (const auto& probe : probes_) {
    if (const auto note = probe->note()) notes.push_back(*note);
  }
  return notes;
}

void check_probes(const Problem& problem, const LagrangianPhase& phase) {
  if (problem.phase.at_stages) return;  // a later stage may bring the material
  const std::vector<double> nothing(phase.size());
  const PointData data = problem.probes.empty() ? PointData() : phase.fields().point_data();
  std::unique_ptr<PlaceReader> places;
  for (std::size_t k = 0; k < problem.probes.size(); ++k) {
    const ProbeSpec& probe = problem.probes[k];
    const std::string key = fmt::format("probe[{}]", k);
    if (probe.point && static_cast<std::size_t>(*probe.point) > phase.points())
      throw_scene_error(key + ".point",
                        fmt::format("there is no material point {}; expected 1 to {}", *probe.point, phase.points()));
    if (probe.kind == ProbeKind::point && !probe.point && probe.frame == ProbeFrame::material) {
      if (!places) places = phase.fields().read_places(0, nothing, nothing);
      if (!places->holds(probe.at)) throw_scene_error(key + ".at", "there is no material at this place");
    }
    if (probe.kind != ProbeKind::mean) continue;
    if (!has_points_in_box(data, probe)) throw_scene_error(key + ".min", "there is no material point in this box");
  }
}

}  // namespace stillpoint

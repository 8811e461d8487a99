// What is written out.
#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// A name that becomes part of a column of history.csv.
void check_name(SceneCheck& check, const std::string& name, const std::string& key) {
  const bool printable = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == ',' || c == '"';
  });
  if (!printable)
    check.add(key, "names a column of history.csv and cannot hold a comma, a quote or a control character");
}

std::vector<std::string> fields_of(const ProbeSpec& probe, int dim) {
  return probe.kind == ProbeKind::body ? body_fields(dim) : probe_fields(dim);
}

void check_fields(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  const std::vector<std::string> known = fields_of(probe, check.scene().dim);
  if (!check.given(key + ".fields", !probe.fields.empty())) return check.add(key, "the key 'fields' is missing");
  if (probe.fields.empty() && check.sound(key + ".fields"))
    check.add(key + ".fields", fmt::format("name at least one of {}", fmt::join(known, ", ")));
  for (std::size_t k = 0; k < probe.fields.size(); ++k) {
    const std::string& field = probe.fields[k];
    const std::string path = fmt::format("{}.fields[{}]", key, k);
    const auto here = probe.fields.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::find(known.begin(), known.end(), field) == known.end()) {
      check.add(path, unknown_word("unknown field", field, known));
    } else if (std::find(probe.fields.begin(), here, field) != here) {
      check.add(path, fmt::format("{} is there already", in_quotes(field)));
    }
  }
}

/// A place that does not move with the material.
void check_fixed_place(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  if (probe.frame == ProbeFrame::material || !check.given(key + ".at", !probe.at.empty())) return;
  const PhaseSpec& phase = check.scene().phase;
  if (!phase.ends())
    return check.add(
        key + ".frame",
        "in a single phase everything is said of where the material was at the start, and none passes a place; "
        "expected \"material\", or phases (phase.max_motion = 0.1)");
  for (std::size_t k = 0; k < probe.fields.size(); ++k) {
    if (probe.fields[k] == "u" || probe.fields[k].starts_with("u."))
      check.add(fmt::format("{}.fields[{}]", key, k),
                "a place that stays has no displacement, and the material in it is ever another; expected v, strain or "
                "stress, or frame = \"material\"");
  }
}

void check_box(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  for (const char* corner : {"min", "max"}) {
    const bool has_value = !(std::string_view(corner) == "min" ? probe.min : probe.max).empty();
    if (!check.given(fmt::format("{}.{}", key, corner), has_value))
      check.add(key, fmt::format("the key '{}' is missing: {} the material points in a box", corner,
                                 probe.kind == ProbeKind::mean ? "a mean is over" : "in space a slope is that of"));
  }
  for (std::size_t d = 0; d < std::min(probe.min.size(), probe.max.size()); ++d) {
    if (!(probe.min[d] <= probe.max[d]))
      check.add(check.axis_key(key + ".max", d),
                fmt::format("must be at least min, {}, not {}", probe.min[d], probe.max[d]));
  }
}

/// What adds up to nothing around an axis of symmetry.
void check_sums(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  if (check.scene().state != StressState::axisymmetric) return;
  for (const std::string& field : probe.fields)
    if (field == "momentum.x" || field == "angular_momentum")
      check.add(key + ".fields", fmt::format("{} is nothing around an axis of symmetry; take momentum.y", field));
}

/// The keys that go with the kind of a probe.
void check_kind(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  if (!check.sound(key + ".kind")) return;
  const char* const of_point = "goes with a point only";
  switch (probe.kind) {
    case ProbeKind::slope_angle:
      if (check.scene().dim == 1) check.add(key + ".kind", "a slope has no angle in one dimension");
      if (check.scene().dim == 3) {
        check_box(check, probe, key);
      } else {
        check.refuse(key, {"min", "max"}, "goes with kind = \"mean\", in space with the angle of a slope too");
      }
      return check.refuse(key, {"point", "at", "frame", "fields"},
                          "goes with a point only; the angle of a slope has nothing but a name");
    case ProbeKind::point:
      check.one_of(key, {"point", probe.point.has_value()}, {"at", !probe.at.empty()},
                   "give either point or at, not both",
                   "give point, the number of a material point, or at, a position");
      check.refuse(key, {"min", "max"}, "goes with kind = \"mean\" only");
      if (probe.point) check.refuse(key, {"frame"}, "goes with at only: a material point moves");
      check_fixed_place(check, probe, key);
      break;
    case ProbeKind::mean:
      check.refuse(key, {"point", "at", "frame"}, of_point);
      check_box(check, probe, key);
      break;
    case ProbeKind::body:
      check.refuse(key, {"point", "at", "frame"}, of_point);
      check.refuse(key, {"min", "max"}, "goes with kind = \"mean\" only");
      check_sums(check, probe, key);
      break;
  }
  check_fields(check, probe, key);
}

/// A place of the material is one of the body; any other one only has to be one that material can come to.
void check_place(SceneCheck& check, const ProbeSpec& probe, const std::optional<BodyBox>& body,
                 const std::string& key) {
  const GridSpec& grid = check.scene().grid;
  if (probe.frame == ProbeFrame::material && body) check.inside(probe.at, body->min, body->max, body->name, key);
  if (probe.frame == ProbeFrame::space && body) check.inside(probe.at, grid.min, grid.max, "grid", key);
}

void check_probes(SceneCheck& check, const std::optional<BodyBox>& body) {
  const Scene& scene = check.scene();
  const std::set<std::string> names = check.unique_names("probe", scene.probes);
  const bool by_number =
      std::ranges::any_of(scene.probes, [](const ProbeSpec& probe) { return probe.point.has_value(); });
  const long points = body && by_number ? known_points(check) : 0;
  for (std::size_t k = 0; k < scene.probes.size(); ++k) {
    const ProbeSpec& probe = scene.probes[k];
    const std::string key = fmt::format("probe[{}]", k);
    check_place(check, probe, body, key + ".at");
    if (points > 0 && probe.point && *probe.point > points)
      check.add(key + ".point", fmt::format("there are {} material points, so {} is too large", points, *probe.point));
    check_name(check, probe.name, key + ".name");
    check_kind(check, probe, key);
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const std::string& name = scene.walls[k].name;
    const std::string key = fmt::format("wall[{}].name", k);
    check_name(check, name, key);
    if (names.contains(name)) check.add(key, fmt::format("there is a probe {} already", in_quotes(name)));
  }
}

void check_stages(SceneCheck& check) {
  const std::vector<double>& stages = check.scene().output.snapshots;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const std::string key = fmt::format("output.stages[{}]", k);
    if (stages[k] < 0) {
      check.add(key, fmt::format("must be at least 0, not {}", stages[k]));
    } else if (k > 0 && stages[k] <= stages[k - 1]) {
      check.add(key, fmt::format("must be later than the time before it, {}, not {}", stages[k - 1], stages[k]));
    } else {
      continue;
    }
    break;  // the rest may only look wrong
  }
}

}  // namespace

void check_output(SceneCheck& check, const std::optional<BodyBox>& body) {
  check_probes(check, body);
  check_stages(check);
}

}  // namespace stillpoint

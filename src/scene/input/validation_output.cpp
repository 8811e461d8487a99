// Checks of the keys that say what is written out.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// The fields that a probe may name: those of every scene, and those of laws of a user's own in this one.
std::vector<std::string> known_fields(SceneCheck& check, const ProbeSpec& probe) {
  const int dim = check.scene().dim;
  if (probe.kind == ProbeKind::body) return body_fields(dim);
  std::vector<std::string> known = probe_fields(dim);
  const auto add = [&](std::string_view name) {
    if (!name.empty() && std::ranges::find(known, name) == known.end()) known.emplace_back(name);
  };
  for (const auto& [of, material] : check.scene().materials) {
    std::ranges::for_each(material.statev, add);
    if (const LawInfo* const law = check.catalogue().law(material.law)) std::ranges::for_each(law->fields, add);
  }
  return known;
}

void check_fields(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  const std::vector<std::string> known = known_fields(check, probe);
  if (check.wrong_if(!check.given(key + ".fields", !probe.fields.empty()), key, "the key 'fields' is missing")) return;
  check.wrong_if(probe.fields.empty() && check.sound(key + ".fields"), key + ".fields", "name at least one of {}",
                 fmt::join(known, ", "));
  for (std::size_t k = 0; k < probe.fields.size(); ++k) {
    const std::string& field = probe.fields[k];
    const std::string path = fmt::format("{}.fields[{}]", key, k);
    const auto here = probe.fields.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::ranges::find(known, field) == known.end()) {
      check.add(path, unknown_word("unknown field", field, known));
    } else {
      check.wrong_if(std::find(probe.fields.begin(), here, field) != here, path, "{} is there already",
                     in_quotes(field));
    }
  }
}

/// Checks a position that does not move with the material.
void check_fixed_position(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  if (probe.frame == ProbeFrame::material || !check.given(key + ".at", !probe.at.empty())) return;
  if (check.wrong_if(!check.scene().phase.ends(), key + ".frame",
                     "in a single phase everything is said of where the material was at the start, and none passes a "
                     "place; expected \"material\", or phases (phase.max_motion = 0.1)"))
    return;
  for (std::size_t k = 0; k < probe.fields.size(); ++k)
    check.wrong_if(probe.fields[k] == "u" || probe.fields[k].starts_with("u."), fmt::format("{}.fields[{}]", key, k),
                   "a place that stays has no displacement, and the material in it is ever another; expected v, strain "
                   "or stress, or frame = \"material\"");
}

void check_box(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  for (const auto& [corner, value] : {std::pair("min", &probe.min), {"max", &probe.max}})
    check.wrong_if(!check.given(fmt::format("{}.{}", key, corner), !value->empty()), key,
                   "the key '{}' is missing: {} the material points in a box", corner,
                   probe.kind == ProbeKind::mean ? "a mean is over" : "in space a slope is that of");
  for (std::size_t d = 0; d < std::min(probe.min.size(), probe.max.size()); ++d)
    check.wrong_if(!(probe.min[d] <= probe.max[d]), check.axis_key(key + ".max", d), "must be at least min, {}, not {}",
                   probe.min[d], probe.max[d]);
}

/// Checks the keys that go with the kind of a probe.
void check_kind(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  if (!check.sound(key + ".kind")) return;
  const int dim = check.scene().dim;
  const bool slope = probe.kind == ProbeKind::slope_angle, point = probe.kind == ProbeKind::point;
  const bool mean = probe.kind == ProbeKind::mean, body = probe.kind == ProbeKind::body;
  check.wrong_if(slope && dim == 1, key + ".kind", "a slope has no angle in one dimension");
  if (slope && dim == 3) check_box(check, probe, key);
  check.refuse_if(slope && dim != 3, key, {"min", "max"},
                  "goes with kind = \"mean\", in space with the angle of a slope too");
  check.refuse_if(slope, key, {"point", "at", "frame", "fields"},
                  "goes with a point only; the angle of a slope has nothing but a name");
  if (point)
    check.one_of(key, {"point", probe.point.has_value()}, {"at", !probe.at.empty()},
                 "give either point or at, not both", "give point, the number of a material point, or at, a position");
  check.refuse_if(mean || body, key, {"point", "at", "frame"}, "goes with a point only");
  check.refuse_if(point || body, key, {"min", "max"}, "goes with kind = \"mean\" only");
  check.refuse_if(point && probe.point, key, {"frame"}, "goes with at only: a material point moves");
  if (point) check_fixed_position(check, probe, key);
  if (mean) check_box(check, probe, key);
  for (const std::string& field : probe.fields)
    check.wrong_if(body && check.scene().state == StressState::axisymmetric &&
                       (field == "momentum.x" || field == "angular_momentum"),
                   key + ".fields", "{} is nothing around an axis of symmetry; take momentum.y", field);
  if (!slope) check_fields(check, probe, key);
}

void check_probes(SceneCheck& check, const std::optional<NamedBox>& body) {
  const Scene& scene = check.scene();
  const std::set<std::string> names = check.unique_names("probe", scene.probes);
  const bool by_number =
      std::ranges::any_of(scene.probes, [](const ProbeSpec& probe) { return probe.point.has_value(); });
  const long points = body && by_number ? known_points(check) : 0;
  for (std::size_t k = 0; k < scene.probes.size(); ++k) {
    const ProbeSpec& probe = scene.probes[k];
    const std::string key = fmt::format("probe[{}]", k);
    // A position of the material lies in the body, any other one where material can come to.
    if (body) check.inside(probe.at, probe.frame == ProbeFrame::material ? *body : check.grid_box(), key + ".at");
    check.wrong_if(points > 0 && probe.point.value_or(0) > points, key + ".point",
                   "there are {} material points, so {} is too large", points, probe.point.value_or(0));
    check.column_name(probe.name, key + ".name");
    check_kind(check, probe, key);
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const std::string& name = scene.walls[k].name;
    const std::string key = fmt::format("wall[{}].name", k);
    check.column_name(name, key);
    check.wrong_if(names.contains(name), key, "there is a probe {} already", in_quotes(name));
  }
}

void check_snapshots(SceneCheck& check) {
  check.wrong_if(check.scene().output.format.empty(), "output.format", "must name a format, \"xdmf\" or \"vtu\"");
  const std::vector<double>& stages = check.scene().output.snapshots;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const std::string key = fmt::format("output.stages[{}]", k);
    if (check.wrong_if(stages[k] < 0, key, "must be at least 0, not {}", stages[k]) ||
        (k > 0 && check.wrong_if(stages[k] <= stages[k - 1], key, "must be later than the time before it, {}, not {}",
                                 stages[k - 1], stages[k])))
      break;  // the rest may only look wrong
  }
}

}  // namespace

void check_output(SceneCheck& check, const std::optional<NamedBox>& body) {
  check_probes(check, body);
  check_snapshots(check);
}

}  // namespace stillpoint

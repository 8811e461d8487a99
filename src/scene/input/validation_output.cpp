// What is written out.
#include <algorithm>
#include <set>

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

void check_fields(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  const std::vector<std::string> known = probe_fields(check.scene().dim);
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

/// The keys that go with the kind of a probe.
void check_kind(SceneCheck& check, const ProbeSpec& probe, const std::string& key) {
  const int dim = check.scene().dim;
  if (!check.sound(key + ".kind")) return;
  if (probe.kind == ProbeKind::slope_angle) {
    if (dim == 1) check.add(key + ".kind", "a slope has an angle in two dimensions only");
    return check.refuse(key, {"point", "at", "fields"},
                        "goes with a point only; the angle of a slope has nothing but a name");
  }
  check.one_of(key, "point", "at", "give either point or at, not both",
               "give point, the number of a material point, or at, a position");
  if (!check.written(key + ".fields")) {
    check.add(key, "the key 'fields' is missing");
  } else if (probe.fields.empty() && check.sound(key + ".fields")) {
    check.add(key + ".fields", fmt::format("name at least one of {}", fmt::join(probe_fields(dim), ", ")));
  }
  check_fields(check, probe, key);
}

void check_probes(SceneCheck& check, const std::optional<BodyBox>& body) {
  Scene& scene = check.scene();
  const std::set<std::string> names = check.unique_names("probe", scene.probes);
  const bool by_number =
      std::ranges::any_of(scene.probes, [](const ProbeSpec& probe) { return probe.point.has_value(); });
  const long points = body && by_number ? known_points(check) : 0;
  for (std::size_t k = 0; k < scene.probes.size(); ++k) {
    ProbeSpec& probe = scene.probes[k];
    const std::string key = fmt::format("probe[{}]", k);
    if (body) check.inside(probe.at, body->min, body->max, body->name, key + ".at");
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

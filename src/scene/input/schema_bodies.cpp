// The bodies of a scene and what they are made of.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "scene/input/schema_parts.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {
namespace {

constexpr int kMostPointsPerLine = 1000;  // along the coordinate of a cell in one dimension
constexpr int kMostPointsPerSide = 100;   // along each coordinate in more

/// Points along each coordinate of a cell: an array, or a plain number, which in two dimensions counts the cell's
/// points.
std::optional<std::vector<int>> points_per_cell(TableReader& body, int dim) {
  const std::string key = "points_per_cell";
  const int most = dim == 1 ? kMostPointsPerLine : kMostPointsPerSide;
  if (dim == 1 || body.is_array(key)) return body.integers(key, static_cast<std::size_t>(dim), 1, most);
  const auto count = body.integer(key, 1, std::int64_t{most} * most);
  if (!count) return std::nullopt;
  const int along = static_cast<int>(std::lround(std::sqrt(static_cast<double>(*count))));
  if (std::int64_t{along} * along == *count) return std::vector(static_cast<std::size_t>(dim), along);
  body.problem(
      key,
      fmt::format("must be a square (4 is 2 × 2 points in a cell), or an array [along x, along y]; not {}", *count));
  return std::nullopt;
}

/// At least three corners, and not more than can be compared two by two.
std::optional<std::vector<std::vector<double>>> polygon(TableReader& body) {
  constexpr std::size_t most = 1000;
  auto corners = body.places("polygon", 2);
  if (!corners || (corners->size() >= 3 && corners->size() <= most)) return corners;
  body.problem("polygon", fmt::format("needs from 3 to {} corners, not {}", most, corners->size()));
  return std::nullopt;
}

/// Reports the keys that do not go with another one.
void exclude(TableReader& body, std::initializer_list<const char*> keys, const std::string& why) {
  for (const std::string key : keys)
    if (body.has(key)) body.problem(key, why);
}

Words<StressState> states(int dim) {
  if (dim == 1)
    return {{"uniaxial-stress", StressState::uniaxial_stress}, {"uniaxial-strain", StressState::uniaxial_strain}};
  return {{"plane-strain", StressState::plane_strain},
          {"plane-stress", StressState::plane_stress},
          {"axisymmetric", StressState::axisymmetric}};
}

/// state: what the bodies before this one said, if any did.
void read_body(TableReader body, Scene& scene, std::optional<StressState>& state) {
  const std::size_t axes = count_of_axes(scene);
  BodySpec& spec = scene.bodies.emplace_back();
  body.require({"material"});
  // Empty where nothing sound is said.
  if (body.written() && !body.has("min")) spec.min = scene.grid.min;
  if (body.written() && !body.has("max")) spec.max = scene.grid.max;
  assign(spec.min, body.numbers("min", axes));
  assign(spec.max, body.numbers("max", axes));
  if (scene.dim == 2) assign(spec.polygon, polygon(body));
  if (const auto file = body.name("file")) spec.file = scene.file.parent_path() / *file;
  assign(spec.material, body.name("material"));
  if (const auto said = body.choice("state", states(scene.dim))) {
    if (state && *state != *said) body.problem("state", "must be the same in all bodies");
    if (!state) state = said;
  }
  assign(spec.area, body.number(scene.dim == 1 ? "area" : "thickness", kPositive));
  spec.points_per_cell.assign(axes, 2);
  assign(spec.points_per_cell, points_per_cell(body, scene.dim));
  assign(spec.placement, body.choice("placement", Words<Placement>{{"uniform", Placement::uniform},
                                                                   {"gauss", Placement::gauss},
                                                                   {"random", Placement::random}}));
  assign(spec.jitter, body.number("jitter", {0, 1, true, false}));
  assign(spec.volumes, body.choice("volumes", Words<VolumeRule>{{"equal", VolumeRule::equal},
                                                                {"consistent", VolumeRule::consistent}}));
  assign(spec.seed, body.integer("seed", 0, kNoLimit));

  if (body.has("file")) {
    exclude(body,
            {"min", "max", "polygon", "area", "thickness", "points_per_cell", "placement", "jitter", "volumes", "seed"},
            "does not go with file, which holds the points and their volumes");
  } else if (body.has("polygon")) {
    exclude(body, {"min", "max"}, "does not go with polygon; give one of them");
  }
  if (spec.jitter > 0 && spec.placement == Placement::random)
    body.problem("jitter", "does not go with placement = \"random\": random points have no spacing");
  body.report_unknown_keys();
}

void read_material(const std::string& name, TableReader material, Scene& scene) {
  MaterialSpec& spec = scene.materials[name];
  spec.name = name;
  material.require({"law"});
  const auto law = material.choice("law", names_of(material_laws()));
  if (!law) return;  // which other keys belong here is not known
  spec.law = *law;
  const auto info = std::find_if(material_laws().begin(), material_laws().end(),
                                 [&](const LawInfo& one) { return one.name == *law; });
  for (const ParameterInfo& parameter : info->parameters) {
    const std::string key(parameter.name);
    if (parameter.required) material.require({key.c_str()});
    const auto value = material.number(key, {parameter.lower, parameter.upper, parameter.lower_allowed, false});
    if (!value && material.has(key)) continue;  // nothing sound is known of it
    const auto same = spec.parameters.find(std::string(parameter.same_as));
    spec.parameters[key] = value ? *value : same != spec.parameters.end() ? same->second : parameter.fallback;
  }
  for (const ChoiceInfo& choice : info->choices) {
    const std::string key(choice.name);
    const auto word = material.choice(key, std::vector<std::string>(choice.values.begin(), choice.values.end()));
    spec.choices[key] = word.value_or(std::string(choice.fallback));
  }
  material.report_unknown_keys();
}

}  // namespace

void read_bodies(TableReader& root, Scene& scene) {
  std::optional<StressState> state;
  for (TableReader& body : root.one_or_more_tables("body", "a scene has a body with a material"))
    read_body(std::move(body), scene, state);
  scene.state = state.value_or(scene.dim == 1 ? StressState::uniaxial_stress : StressState::plane_strain);
}

void read_materials(TableReader& root, Scene& scene) {
  for (auto& [name, material] : root.named_tables("material")) read_material(name, std::move(material), scene);
}

}  // namespace stillpoint

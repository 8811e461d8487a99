#include <stillpoint/damping.hpp>
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <tuple>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/constants.hpp"
#include "scene/input/schema.hpp"
#include "scene/input/toml_source.hpp"
#include "scene/input/validation.hpp"

namespace stillpoint {
namespace {

/// A step and a fraction of the critical one exclude each other: what --set gives replaces what the file says.
void drop_what_it_replaces(toml::table& table, const std::string& override_text) {
  toml::table* const integrator = table["integrator"].as_table();
  if (!integrator) return;
  const std::string key = override_text.substr(0, override_text.find_first_of(" \t="));
  if (key == "integrator.step") integrator->erase("step_fraction");
  if (key == "integrator.step_fraction") integrator->erase("step");
}

bool from_override(const toml::node* node) { return node && location_of(node->source()).line == 0; }

/// A choice given by --set leaves the keys of the file's own one without meaning: those that it does not take go.
void drop_keys_of_other_choices(toml::table& root, const char* table_name, const char* choice,
                                const std::function<bool(const std::string& value, const std::string& key)>& takes,
                                std::initializer_list<const char*> keys) {
  toml::table* const table = root[table_name].as_table();
  const toml::node* const chosen = table ? table->get(choice) : nullptr;
  const auto value = chosen ? chosen->value<std::string>() : std::nullopt;
  if (!value || !from_override(chosen)) return;
  for (const char* key : keys) {
    const toml::node* const node = table->get(key);
    if (node && !from_override(node) && !takes(*value, key)) table->erase(key);
  }
}

void drop_keys_of_other_transfers(toml::table& root) {
  const auto takes = [](const std::string& transfer, const std::string& key) {
    return key == "flip_share" ? transfer == "flip" : transfer == "xpic";
  };
  drop_keys_of_other_choices(root, "phase", "transfer", takes, {"flip_share", "xpic_order"});
}

void drop_keys_of_other_strategies(toml::table& root) {
  const auto takes = [](const std::string& strategy, const std::string& key) {
    const DampingInfo* info = known_damping(strategy);
    return !info || info->takes(key);  // what does not exist is reported by itself
  };
  drop_keys_of_other_choices(root, "damping", "strategy", takes, {"c", "alpha", "peak", "quotient"});
  const auto strategy = root["damping"]["strategy"];
  toml::table* const integrator = root["integrator"].as_table();
  const DampingInfo* info = known_damping(strategy.value_or(std::string()));
  if (!integrator || !from_override(strategy.node()) || !info || !info->has_own_step) return;
  for (const char* step : {"step", "step_fraction"}) {  // it has its own
    if (!from_override(integrator->get(step))) integrator->erase(step);
  }
}

/// The scene in a file's text under overrides; complete only where problems stays empty.
Scene read_scene(const std::string& text, const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 std::vector<Problem>& problems) {
  Scene scene;
  scene.file = file;
  scene.name = file.stem().string();
  auto table = parse_toml(text, file.string(), problems);
  if (!table) return scene;
  for (const std::string& text_of_override : overrides) {
    drop_what_it_replaces(*table, text_of_override);
    apply_override(*table, text_of_override, problems);
  }
  drop_keys_of_other_transfers(*table);
  drop_keys_of_other_strategies(*table);
  scene.where = locations_of(*table);

  Reading reading;
  if (const auto* constants = table->get_as<toml::table>("constants")) resolve_constants(*constants, reading);
  scene.constants = reading.constants;
  TableReader root(&*table, "", {file.string(), 1, 1}, reading);
  if (read_schema(root, scene)) validate(scene, reading.problems);
  problems.insert(problems.end(), reading.problems.begin(), reading.problems.end());
  return scene;
}

bool same(const Problem& a, const Problem& b) {
  return a.message == b.message && to_string(a.where) == to_string(b.where);
}

/// Loads the file once for each variant, and reports at the variant what the file itself does not suffer from.
/// Overrides stay out of it: a variant that does not go with them is no fault of the scene that was asked for.
void check_variants(const Scene& scene, const std::string& text, std::vector<Problem>& problems) {
  std::vector<Problem> own;
  read_scene(text, scene.file, {}, own);
  for (std::size_t k = 0; k < scene.variants.size(); ++k) {
    std::vector<Problem> found;
    read_scene(text, scene.file, scene.variants[k].set, found);
    for (const Problem& problem : found) {
      if (std::any_of(own.begin(), own.end(), [&](const Problem& other) { return same(problem, other); })) continue;
      problems.push_back({scene.location(fmt::format("variant[{}].set", k)),
                          fmt::format("variant {}: {}", in_quotes(scene.variants[k].name), problem.message)});
    }
  }
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  std::vector<Problem> problems;
  const auto text = read_file(file, problems);
  if (!text) throw SceneError(std::move(problems));
  Scene scene = read_scene(*text, file, overrides, problems);
  constexpr std::size_t most_variants = 1000;
  if (scene.variants.size() > most_variants) {
    problems.push_back({scene.location("variant"), fmt::format("more than {} variants", most_variants)});
  } else {
    check_variants(scene, *text, problems);
  }
  if (problems.empty()) return scene;
  // In the order of the file, overrides first, other files last.
  const auto place = [&](const Problem& problem) {
    const Location& where = problem.where;
    return std::tuple(where.line > 0 && where.file != file.string(), where.line, where.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
  throw SceneError(std::move(problems));
}

}  // namespace stillpoint

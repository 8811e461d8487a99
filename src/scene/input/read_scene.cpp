#include "scene/input/read_scene.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/keys.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/input/toml_source.hpp"
#include "scene/resolve.hpp"
#include "scene/stages.hpp"

namespace stillpoint {
namespace {

bool from_override(const toml::node* node) {
  if (!node) return false;
  const Location where = location_of(node->source());
  return !where.file.empty() && where.line == 0;
}

/// The file's own entry of a table goes; what --set gives stays.
void drop(toml::table& root, std::string_view table_name, std::string_view key) {
  toml::table* const table = root[table_name].as_table();
  if (table && table->get(key) && !from_override(table->get(key))) table->erase(key);
}

/// A step and a fraction of the critical one exclude each other: what --set gives replaces what the file says, or what
/// was given before.
void drop_what_it_replaces(toml::table& root, const std::string& override_text) {
  toml::table* const integrator = root["integrator"].as_table();
  if (!integrator) return;
  const std::string key = override_text.substr(0, override_text.find_first_of(" \t="));
  if (key == "integrator.step") integrator->erase("step_fraction");
  if (key == "integrator.step_fraction") integrator->erase("step");
}

/// A choice given by --set leaves the keys of the file's own choice without meaning: those that it does not take go.
void drop_keys_of_other_choices(toml::table& root, const Catalogue& catalogue) {
  const auto chosen = [&](const char* table, const char* key) {
    const auto node = root[table][key];
    return from_override(node.node()) ? node.value_or(std::string()) : std::string();
  };
  if (const std::string transfer = chosen("phase", "transfer"); !transfer.empty()) {
    if (transfer != "flip") drop(root, "phase", "flip_share");
    if (transfer != "xpic") drop(root, "phase", "xpic_order");
  }
  if (const StrategyInfo* const strategy = catalogue.strategy(chosen("damping", "strategy"))) {
    for (const char* key : {"c", "alpha", "peak", "quotient"})
      if (!strategy->takes(key)) drop(root, "damping", key);
    for (const char* key : {"step", "step_fraction"})
      if (strategy->has_own_step) drop(root, "integrator", key);
  }
  for (const char* axis : {"x", "y", "z"})
    if (from_override(root["grid"][axis].node()))
      for (const char* key : {"min", "max", "cells"}) drop(root, "grid", key);
  if (!chosen("exact", "solution").empty())
    for (const char* key : {"u", "stress"}) drop(root, "exact", key);
  const StaticMethodInfo* const solver = catalogue.static_method(chosen("solve", "method"));
  if (!chosen("solve", "method").empty() && !solver) drop(root, "solve", "load_steps");
  if (solver) {
    for (const std::string_view name : kTablesOfMotion) {
      std::vector<std::string> keys;
      if (const toml::table* const table = root[name].as_table())
        for (auto&& [key, node] : *table) keys.emplace_back(key.str());
      for (const std::string& key : keys) drop(root, name, key);
    }
  }
}

/// Files that a scene names lie beside its own.
void find_files(Scene& scene) {
  for (BodySpec& body : scene.bodies)
    for (std::filesystem::path* const file : {&body.file, &body.stl, &body.mesh})
      if (!file->empty()) *file = scene.file.parent_path() / *file;
  if (!scene.initial_from.empty()) scene.initial_from = scene.file.parent_path() / scene.initial_from;
  for (RigidSpec& rigid : scene.rigid)
    if (!rigid.stl.empty()) rigid.stl = scene.file.parent_path() / rigid.stl;
  for (auto& [name, material] : scene.materials)
    if (!material.library.empty()) material.library = scene.file.parent_path() / material.library;
}

/// Reports what is wrong with the first of the later stages in which something is.
void check_later_stages(Scene scene, Reading& reading, const Catalogue& catalogue) {
  while (!scene.stages.empty()) {
    begin_next_stage(scene);
    Reading of_stage{.dim = reading.dim, .constants = reading.constants};
    try {
      validate(scene, resolve(scene, catalogue), of_stage, catalogue);
    } catch (const EnoughProblems&) {
    }
    for (Mistake& problem : of_stage.problems) {
      problem.message = fmt::format("in the stage at t = {:.6g}: {}", scene.present_stage->at, problem.message);
      reading.add(std::move(problem));
    }
    if (!of_stage.problems.empty()) return;
  }
}

/// A scene under overrides, with all that it may choose from.
class SceneText {
 public:
  SceneText(const std::filesystem::path& file, std::string text, std::string name, const Catalogue& catalogue)
      : file_(file),
        text_(std::move(text)),
        name_(std::move(name)),
        catalogue_(catalogue),
        tables_(scene_tables(catalogue)) {}

  /// Complete only if problems stays empty.
  Scene read(const std::vector<std::string>& overrides, std::vector<Mistake>& problems) const {
    Scene scene;
    scene.file = file_;
    scene.name = file_.stem().string();
    scene.text = text_;
    scene.overrides = overrides;
    auto root = parse_toml(text_, name_, problems);
    if (!root) return scene;
    for (const std::string& text : overrides) {
      drop_what_it_replaces(*root, text);
      apply_override(*root, text, problems);
    }
    drop_keys_of_other_choices(*root, catalogue_);
    scene.where = locations_of(*root);
    Reading reading;
    try {
      if (read_tables(tables_, *root, scene, reading)) {
        find_files(scene);
        set_later_parts_aside(scene, scene.where);
        const std::vector<FileMistake> files = resolve(scene, catalogue_);
        validate(scene, files, reading, catalogue_);
        if (reading.problems.empty()) check_later_stages(scene, reading, catalogue_);
      }
    } catch (const EnoughProblems&) {
    }
    problems.insert(problems.end(), reading.problems.begin(), reading.problems.end());
    return scene;
  }

  /// Reads the file once for each variant, and reports at the variant what the file itself does not suffer from.
  /// Overrides stay out of it: a variant that does not go with them is no fault of the scene that was asked for.
  void check_variants(const Scene& scene, std::vector<Mistake>& problems) const {
    constexpr std::size_t most = 1000, most_bytes = std::size_t{32} << 20;
    const auto add = [&](const std::string& key, std::string message) {
      const Location where = scene.location(key);
      problems.push_back({where, std::move(message), where.file.empty() ? key : ""});
    };
    if (scene.variants.size() > most) return add("variant", fmt::format("more than {} variants", most));
    if (scene.variants.size() * text_.size() > most_bytes)
      return add("variant", fmt::format("{} variants of a scene of {} bytes are more than this program reads",
                                        scene.variants.size(), text_.size()));
    std::vector<Mistake> own;
    if (!scene.variants.empty()) read({}, own);
    for (std::size_t k = 0; k < scene.variants.size(); ++k) {
      std::vector<Mistake> found;
      read(scene.variants[k].set, found);
      for (const Mistake& problem : found) {
        const auto same = [&](const Mistake& other) {
          return problem.message == other.message && to_string(problem.where) == to_string(other.where);
        };
        if (std::ranges::any_of(own, same)) continue;
        add(fmt::format("variant[{}].set", k),
            fmt::format("variant {}: {}", in_quotes(scene.variants[k].name), problem.message));
      }
    }
  }

 private:
  const std::filesystem::path& file_;
  std::string text_, name_;
  const Catalogue& catalogue_;
  std::vector<TableInfo> tables_;
};

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const Catalogue& catalogue) {
  std::vector<Mistake> problems;
  auto text = read_file(file, problems);
  if (!text) throw SceneError(std::move(problems));
  return read_scene(file, std::move(*text), file.string(), overrides, catalogue);
}

Scene read_scene(const std::filesystem::path& file, std::string text, std::string name,
                 const std::vector<std::string>& overrides, const Catalogue& catalogue) {
  std::vector<Mistake> problems;
  const SceneText scene_text(file, std::move(text), std::move(name), catalogue);
  Scene scene = scene_text.read(overrides, problems);
  scene_text.check_variants(scene, problems);
  if (problems.empty()) return scene;
  // In the order of the file, overrides first, other files last.
  const auto position = [&](const Mistake& problem) {
    const Location& where = problem.where;
    return std::tuple(where.line > 0 && where.file != file.string(), where.line, where.column);
  };
  std::ranges::stable_sort(problems, {}, position);
  for (Mistake& problem : problems)
    problem.message = one_line(problem.message);  // keys and TOML's own words may be more
  throw SceneError(std::move(problems));
}

Scene read_again(const Scene& scene, const std::vector<std::string>& more, const Catalogue& catalogue) {
  std::vector<std::string> overrides = scene.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  return read_scene(scene.file, scene.text, scene.location("").file, overrides, catalogue);
}

Problem resolved(Problem problem, const Catalogue& catalogue) {
  Scene scene(std::move(problem));
  Reading reading{.dim = scene.dim, .constants = scene.constants};
  try {
    set_later_parts_aside(scene, scene.where);
    const std::vector<FileMistake> files = resolve(scene, catalogue);
    validate(scene, files, reading, catalogue);
    if (reading.problems.empty()) check_later_stages(scene, reading, catalogue);
  } catch (const EnoughProblems&) {
  }
  if (!reading.problems.empty()) throw SceneError(std::move(reading.problems));
  return static_cast<Problem&>(scene);
}

}  // namespace stillpoint

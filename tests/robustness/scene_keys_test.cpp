// The table of keys against what is made of it: the reader, the reference and the schema in problems/, and its scenes.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "files.hpp"
#include "plan/catalogue.hpp"
#include "scene/input/keys.hpp"
#include "scene/input/read_scene.hpp"

using namespace stillpoint;
using stillpoint::test::contents;
using stillpoint::test::json_of;

namespace {

const std::filesystem::path kProblems = STILLPOINT_PROBLEMS;

/// A value in the range of a key, as TOML.
std::string example_of(const KeyInfo& key, int dim) {
  const Range& range = key.range;
  std::string one =
      fmt::format("{}", range.lower_allowed                                        ? range.lower
                        : std::isfinite(range.lower) && std::isfinite(range.upper) ? (range.lower + range.upper) / 2
                                                                                   : 1.0);
  if (key.kind == Kind::whole && !key.words.empty()) one = "0";
  if (key.kind == Kind::truth) one = "true";
  if (key.kind == Kind::text) one = key.words.empty() ? "\"a\"" : '"' + key.words_in(dim).front() + '"';
  const auto times = [&](int count) {
    return count == 1 ? one : fmt::format("[{}]", fmt::join(std::vector(static_cast<std::size_t>(count), one), ", "));
  };
  if (key.shape == Shape::axes) return times(key.on_face ? dim - 1 : dim);
  if (key.of_turn) return times(dim == 2 ? 1 : 3);
  if (key.shape == Shape::components) return times(dim == 1 ? 1 : dim == 2 ? 4 : 6);
  if (key.shape == Shape::rows)
    return key.row_lengths[0] == 4 ? "[[1, 2, 4, 2], [3, 5, 6, 0]]" : "[[0, 1, 2], [1, 3.5, 4, 2]]";
  if (key.shape == Shape::list) return fmt::format("[{}]", one);
  if (key.shape == Shape::positions)
    return dim == 2 || key.in_plane ? "[[0, 0], [1, 0], [0, 1]]" : "[[0, 0, 0], [1, 0, 0]]";
  return one;
}

/// A scene with nothing but one key.
std::string scene_with(const TableInfo& table, const std::string& entry, int dim) {
  const bool top = table.path.empty();
  std::string path(table.path);
  if (table.repeat == Repeat::named) path = path.substr(0, path.find('<')) + "a";
  std::string text = top && entry.starts_with("dim") ? "" : fmt::format("dim = {}\n", dim);
  if (!top) text += (table.repeat == Repeat::array ? "[[" + path + "]]" : "[" + path + "]") + "\n";
  if (!table.choice.empty()) text += fmt::format("{} = \"{}\"\n", table.choice_key, table.choice);
  return text + entry + "\n";
}

Reading read(const std::string& text) {
  Scene scene;
  Reading reading;
  read_tables(scene_tables(catalogue()), toml::parse(text), scene, reading);
  return reading;
}

bool says_of(const Reading& reading, const std::string& words) {
  return std::ranges::any_of(reading.problems,
                             [&](const Mistake& p) { return p.message.find(words) != std::string::npos; });
}

/// The schemas that a value may fit, of which one is chosen by anyOf, or an entry of an array.
std::vector<Json> choices_of(const Json& schema) {
  std::vector<Json> result = {schema};
  for (const char* key : {"anyOf", "items"}) {
    if (!schema.contains(key)) continue;
    for (const Json& one : schema[key].is_array() ? schema[key] : Json::array({schema[key]}))
      for (Json& choice : choices_of(one)) result.push_back(std::move(choice));
  }
  return result;
}

/// Whether the schema has a dotted key, "support[0].at".
bool knows(const Json& schema, const std::string& key) {
  const auto dot = key.find('.');
  const std::string name = key.substr(0, std::min(dot, key.find('[')));
  for (const Json& choice : choices_of(schema)) {
    const Json none = Json::object();
    const Json& properties = choice.contains("properties") ? choice["properties"] : none;
    const bool any = choice.contains("additionalProperties") && choice["additionalProperties"].is_object();
    if (!properties.contains(name) && !any) continue;
    const Json& below = properties.contains(name) ? properties[name] : choice["additionalProperties"];
    if (dot == std::string::npos || knows(below, key.substr(dot + 1))) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("the reader takes every key of the table, with an example and with its default") {
  int keys = 0;
  for (const TableInfo& table : scene_tables(catalogue())) {
    for (const KeyInfo& key : table.keys) {
      for (const int dim : {1, 2, 3}) {
        if (!table.is_in(dim) || !key.is_in(dim) || key.name == "law" || key.name.starts_with('<')) continue;
        if (!table.choice.empty() && key.name == table.choice_key) continue;
        std::vector<std::string> values = {example_of(key, dim)};
        const auto words = key.words_in(dim);
        if (std::ranges::find(words, key.fallback) != words.end()) values.push_back('"' + key.fallback + '"');
        if (key.shape == Shape::list && key.fallback.starts_with('[')) values.push_back(key.fallback);
        double number = 0;
        const bool one = key.shape == Shape::one && (key.kind == Kind::number || key.kind == Kind::whole);
        std::istringstream fallback(key.fallback);
        if (one && fallback >> number && fallback.eof()) values.push_back(key.fallback);
        for (const std::string& value : values) {
          const std::string text = scene_with(table, fmt::format("{} = {}", key.name, value), dim);
          const Reading reading = read(text);
          INFO(text);
          for (const Mistake& problem : reading.problems) UNSCOPED_INFO(problem.message);
          CHECK_FALSE(says_of(reading, "unknown key"));
          const std::string name = "." + std::string(key.name);
          CHECK_FALSE(std::ranges::any_of(reading.wrong, [&](const std::string& path) {
            return ("." + path).ends_with(name) || path.find(name + "[") != std::string::npos;
          }));
          ++keys;
        }
      }
    }
  }
  CHECK(keys > 200);
}

TEST_CASE("the reader refuses a key that is in no row of its table") {
  for (const TableInfo& table : scene_tables(catalogue())) {
    if (!table.keys.empty() && table.keys[0].name.starts_with('<')) continue;
    if (table.repeat == Repeat::named && table.choice.empty()) continue;  // which keys it has depends on its law
    const std::string text = scene_with(table, "surely_no_key = 1", 2);
    INFO(text);
    CHECK(says_of(read(text), "unknown key 'surely_no_key'"));
  }
}

TEST_CASE("every row of the table says what its key is for") {
  for (const TableInfo& table : scene_tables(catalogue())) {
    CHECK_FALSE(table.help.empty());
    for (const KeyInfo& key : table.keys) {
      INFO(table.path << "." << key.name);
      CHECK_FALSE(key.help.empty());
    }
  }
}

TEST_CASE("the reference in problems/README.md is that of the table of keys") {
  const std::string readme = contents(kProblems / "README.md");
  const auto generated = readme.find("## Every key\n");
  REQUIRE(generated != std::string::npos);
  INFO(
      "to write it anew: sed -i '/^<!-- Generated/q' problems/README.md && stillpoint list keys --format markdown >> "
      "problems/README.md");
  CHECK(readme.substr(generated) == key_reference(catalogue()));
}

TEST_CASE("the schema in problems/ is that of the table of keys") {
  INFO("to write it anew: stillpoint list keys --format schema > problems/scene.schema.json");
  CHECK(contents(kProblems / "scene.schema.json") == key_schema(catalogue()));
}

TEST_CASE("the schema has every key of every scene in problems/, and no other") {
  const Json schema = json_of(kProblems / "scene.schema.json");
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kProblems)) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    for (const auto& [key, where] : load_scene(entry.path()).where) {
      INFO(to_string(where) << ": " << key);
      const std::string aside = "later_";  // of what stages bring
      CHECK(knows(schema, key.starts_with(aside) ? key.substr(aside.size()) : key));
    }
  }
  CHECK(scenes >= 14);
  for (const char* key :
       {"titel", "grid.mim", "body.polygn", "support[0].fase", "material.sand.pi", "initial.geostatic.k"})
    CHECK_FALSE(knows(schema, key));
}

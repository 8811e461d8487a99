#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/json.hpp"
#include "scene/input/keys.hpp"
#include "scene/input/read_scene.hpp"

namespace stillpoint {
namespace {

bool is_limit(double bound) { return std::abs(bound) < std::numeric_limits<int>::max(); }

/// "number > 0", "whole number, 1 <= value <= 20"
std::string told(const char* kind, const Range& range) {
  const char* const above = range.lower_allowed ? "<=" : "<";
  const char* const below = range.upper_allowed ? "<=" : "<";
  if (is_limit(range.lower) && is_limit(range.upper))
    return fmt::format("{}, {} {} value {} {}", kind, range.lower, above, below, range.upper);
  if (is_limit(range.lower)) return fmt::format("{} {} {}", kind, range.lower_allowed ? ">=" : ">", range.lower);
  return kind;
}

/// The dimensions of scenes that have a key or a word, if not all have it: " (dim = 1)".
std::string told_dims(Dims dims) {
  std::vector<int> in;
  for (int dim = 1; dim <= 3; ++dim)
    if ((dims & dims_of(dim)) != 0) in.push_back(dim);
  return dims == kAnyDim ? "" : fmt::format(" (dim = {})", fmt::join(in, " or "));
}

/// The values that a key takes: "number > 0 | "critical"".
std::string told_type(const KeyInfo& key) {
  std::vector<std::string> kinds;
  const bool word_only = key.kind == Kind::text && !key.words.empty();
  if (key.kind == Kind::number) kinds.push_back(told("number", key.range));
  if (key.kind == Kind::number && !key.variables.empty()) kinds.emplace_back("formula of x, y");
  if (key.kind == Kind::whole)
    kinds.push_back(told("whole number", key.words.empty() ? key.range : key.numbers_in(kAnyDim)));
  if (key.kind == Kind::text && !word_only) kinds.push_back("text");
  if (key.kind == Kind::truth) kinds.push_back("true or false");
  if (key.kind == Kind::formula) {
    const std::string x = key.variables.starts_with('x') ? "x, y" : "";
    kinds.push_back(fmt::format("formula of {}{}{}", x, x.empty() || key.variables == "x" ? "" : ", ",
                                key.variables.ends_with('t') ? "t" : ""));
  }
  if (key.listed_by.empty()) {
    for (auto word = key.words.begin(); word != key.words.end(); ++word) {
      if (std::find_if(key.words.begin(), word, [&](const Word& other) { return other.name == word->name; }) != word)
        continue;  // in scenes of other dimensions another option
      kinds.push_back(fmt::format("\"{}\"{}", word->name, key.kind == Kind::whole ? "" : told_dims(word->dims)));
    }
  } else {
    kinds.push_back(fmt::format("a name of `{}`", key.listed_by));
  }
  std::string one = fmt::format("{}", fmt::join(kinds, " | "));
  switch (key.shape) {
    case Shape::one:
      return one;
    case Shape::axes:
      return one + (key.on_face ? ", for each coordinate along the face" : ", for each coordinate");
    case Shape::components:
      return one + ", for each component";
    case Shape::list:
      return "array of " + one + (key.words.empty() ? "s" : "");
    case Shape::positions:
      return "array of positions";
    case Shape::rows:
      return fmt::format("array of rows {}", key.row);
  }
  return one;
}

std::string told_default(const KeyInfo& key) {
  if (!key.required) return key.fallback;
  return key.unless.empty() ? "required" : fmt::format("required, except beside {}", key.unless.front());
}

std::string told_help(const KeyInfo& key) { return fmt::format("{}{}", key.help, told_dims(key.dims)); }

/// "[stop]", or "[material.<name>] with law = "hencky"".
std::string told_heading(const TableInfo& table) {
  if (table.path.empty()) return "top of the file";
  return table.heading() +
         (table.choice.empty() ? "" : fmt::format(" with {} = \"{}\"", table.choice_key, table.choice));
}

std::string escaped(std::string text) {
  for (const char letter : {'|', '<'})
    for (auto at = text.find(letter); at != std::string::npos; at = text.find(letter, at + 2)) text.insert(at, 1, '\\');
  return text;
}

Json schema_of_one(const KeyInfo& key) {
  if (key.kind == Kind::text) {
    Json words = Json::array();
    for (const Word& word : key.words) words.push_back(word.name);
    return words.empty() || !key.listed_by.empty() ? Json{{"type", "string"}} : Json{{"enum", words}};
  }
  if (key.kind == Kind::truth) return Json{{"type", "boolean"}};
  // A string is a formula, or a word.
  Json schema = {{"type", {key.kind == Kind::whole ? "integer" : "number", "string"}}};
  const Range& range = key.range;
  if (is_limit(range.lower)) schema[range.lower_allowed ? "minimum" : "exclusiveMinimum"] = range.lower;
  if (is_limit(range.upper)) schema[range.upper_allowed ? "maximum" : "exclusiveMaximum"] = range.upper;
  return schema;
}

Json schema_of(const KeyInfo& key) {
  const Json one = schema_of_one(key);
  const auto array = [](const Json& items) { return Json{{"type", "array"}, {"items", items}}; };
  const bool may_be_one = key.shape == Shape::axes || key.shape == Shape::components;
  Json schema = key.shape == Shape::one    ? one
                : may_be_one               ? Json{{"anyOf", {one, array(one)}}}
                : key.shape == Shape::list ? array(one)
                                           : array(array(one));
  if (key.shape == Shape::rows)
    schema["items"].update({{"minItems", key.row_lengths[0]}, {"maxItems", key.row_lengths[1]}});
  schema["description"] =
      told_help(key) + (key.unit.empty() ? "" : fmt::format(" [{}]", key.unit)) +
      (told_default(key).empty() ? "" : fmt::format("; {}{}", key.required ? "" : "default: ", told_default(key)));
  return schema;
}

Json schema_of(const TableInfo& table) {
  Json properties = Json::object(), required = Json::array(), replaceable = Json::array(), replacing = Json::array();
  for (const KeyInfo& key : table.keys) {
    if (key.name.starts_with('<'))
      return {{"type", "object"}, {"description", table.help}, {"additionalProperties", schema_of(key)}};
    properties[std::string(key.name)] = schema_of(key);
    if (!table.choice.empty() && key.name == table.choice_key)
      properties[std::string(key.name)] = {{"const", table.choice}, {"description", table.help}};
    if (key.required && !key.unless.empty()) {
      replaceable.push_back(key.name);
      replacing = Json::array({key.unless.front()});
    } else if (key.required || (!table.choice.empty() && key.name == table.choice_key)) {
      required.push_back(key.name);
    }
  }
  Json schema = {{"type", "object"}, {"description", table.help}, {"properties", properties}};
  if (!required.empty()) schema["required"] = required;
  if (!replaceable.empty())
    schema["anyOf"] = Json::array({Json{{"required", replaceable}}, Json{{"required", replacing}}});
  schema["additionalProperties"] = false;
  return schema;
}

}  // namespace

std::string key_list(const Catalogue& catalogue) {
  std::string text = "keys of a scene\n";
  for (const TableInfo& table : scene_tables(catalogue)) {
    text += fmt::format("  {}: {}{}\n", told_heading(table), table.help, told_dims(table.dims));
    for (const KeyInfo& key : table.keys) {
      if (!table.choice.empty() && key.name == table.choice_key) continue;
      const std::string fallback = told_default(key);
      text += fmt::format("    {:<18}{}{}{}\n    {:<18}  {}\n", key.name, told_type(key),
                          key.unit.empty() ? "" : fmt::format(" [{}]", key.unit),
                          fallback.empty() ? "" : fmt::format("; {}{}", key.required ? "" : "default ", fallback), "",
                          told_help(key));
    }
  }
  return text;
}

std::string key_reference(const Catalogue& catalogue) {
  std::string text =
      "## Every key\n\n"
      "Every number may also be a formula of the constants, in quotes (`\"pi/10\"`). What is said of each coordinate "
      "is an\n"
      "array with one value for each; with `dim = 1` a plain value will do. `--set TABLE.KEY=VALUE` changes any key,\n"
      "`--set probe[0].name=tip` one of an array of tables.\n";
  for (const TableInfo& table : scene_tables(catalogue)) {
    text += fmt::format("\n### {}{}\n\n{}{}\n\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n",
                        table.path.empty() ? "The top of the file" : fmt::format("`{}`", table.heading()),
                        table.choice.empty() ? "" : fmt::format(" with `{} = \"{}\"`", table.choice_key, table.choice),
                        escaped(std::string(table.help) + told_dims(table.dims)),
                        table.needed_for.empty() ? "" : ". Required");
    for (const KeyInfo& key : table.keys)
      if (table.choice.empty() || key.name != table.choice_key)
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, escaped(told_type(key)), key.unit,
                            escaped(told_default(key)), escaped(told_help(key)));
  }
  return text;
}

std::string key_schema(const Catalogue& catalogue) {
  Json schema;
  const auto tables = scene_tables(catalogue);
  for (const TableInfo& table : tables) {
    if (table.path.empty()) {
      schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                {"$comment", "Generated: stillpoint list keys --format schema > problems/scene.schema.json"},
                {"title", "A scene of Stillpoint"}};
      schema.update(schema_of(table));
      schema.erase("description");
      schema["required"] = Json::array();
      continue;
    }
    const std::string path(table.path);
    const auto dot = path.find('.');
    Json* around = &schema["properties"];
    if (table.repeat == Repeat::named) {
      Json& named = (*around)[path.substr(0, dot)];
      if (table.choice.empty()) {
        named = {{"type", "object"}, {"description", table.help}};
      } else {
        named["additionalProperties"]["anyOf"].push_back(schema_of(table));
      }
      continue;
    }
    if (dot != std::string::npos) around = &(*around)[path.substr(0, dot)]["properties"];
    const Json one = schema_of(table);
    const Json array = {{"type", "array"}, {"items", one}};
    Json& own = (*around)[path.substr(dot + 1)];
    if (!table.choice.empty()) {  // beside the table without this choice
      if (!own.contains("anyOf")) {
        own["properties"].erase(std::string(table.choice_key));
        own = {{"anyOf", {own}}};
      }
      own["anyOf"].push_back(one);
      continue;
    }
    own = table.repeat == Repeat::array           ? array
          : table.repeat == Repeat::once_or_array ? Json{{"anyOf", {one, array}}}
                                                  : one;
    if (!table.needed_for.empty()) schema["required"].push_back(path);
  }
  return file_text(schema);
}

}  // namespace stillpoint

#include "scene/input/material_keys.hpp"

#include <map>

#include "scene/input/key_reader.hpp"

namespace stillpoint {
namespace {

/// The keys of a material: its law's.
std::vector<Key> keys_of(const LawInfo& law, const Key& law_key) {
  std::vector<Key> keys = {law_key};
  for (const ParameterInfo& p : law.parameters) {
    const auto value = [name = std::string(p.name)](MaterialSpec& m) -> double& { return m.parameters[name]; };
    keys.push_back(key_of<MaterialSpec>(p.name, value, p.meaning,
                                        {.range = {p.lower, p.upper, p.lower_allowed, false},
                                         .unit = p.unit,
                                         .fallback = p.required          ? ""
                                                     : p.same_as.empty() ? fmt::format("{}", p.fallback)
                                                                         : std::string(p.same_as),
                                         .required = p.required}));
  }
  for (const ChoiceInfo& c : law.choices) {
    const auto value = [name = std::string(c.name)](MaterialSpec& m) -> std::string& { return m.choices[name]; };
    keys.push_back(key_of<MaterialSpec>(
        c.name, value, c.meaning, {.words = {c.values.begin(), c.values.end()}, .fallback = std::string(c.fallback)}));
  }
  return keys;
}

/// Sets what a material does not say, unless what it says is wrong.
void set_defaults(MaterialSpec& material, const LawInfo& law, const FoundTable& found, const Reading& reading) {
  const auto missing = [&](const auto& values, std::string_view name) {
    return !values.contains(std::string(name)) && !reading.wrong.contains(fmt::format("{}.{}", found.path, name));
  };
  for (const ParameterInfo& p : law.parameters) {
    if (!missing(material.parameters, p.name)) continue;
    const auto same = material.parameters.find(std::string(p.same_as));
    material.parameters[std::string(p.name)] = same == material.parameters.end() ? p.fallback : same->second;
  }
  for (const ChoiceInfo& c : law.choices)
    if (missing(material.choices, c.name)) material.choices[std::string(c.name)] = c.fallback;
}

}  // namespace

std::vector<TableInfo> material_tables(const Catalogue& catalogue) {
  const auto law_key =
      key_of<MaterialSpec>("law", &MaterialSpec::law, "`stillpoint list materials` has their equations",
                           {.words = names_of(catalogue.laws), .required = true});
  std::vector<TableInfo> tables = {
      {.path = "material.<name>", .help = "what bodies are made of", .repeat = Repeat::named, .keys = {law_key.info}}};
  std::map<std::string, std::vector<Key>> keys;
  for (const LawInfo& law : catalogue.laws) {
    const auto& of_law = keys[std::string(law.name)] = keys_of(law, law_key);
    tables.push_back({.path = "material.<name>",
                      .help = law.equation,
                      .repeat = Repeat::named,
                      .law = law.name,
                      .keys = infos_of(of_law)});
  }
  tables[0].read = [&catalogue, law_key, keys](const TableInfo& self, const toml::table& root, Scene& scene,
                                               Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) {
      MaterialSpec& material = scene.materials[found.name];
      material.name = found.name;
      if (const toml::node* const law = found.table.get("law")) {
        law_key.read(&material, {*law, found.path + ".law", reading}, law_key.info);
      } else {
        reading.problem(location_of(found.table.source()), found.path, "the key 'law' is missing");
      }
      if (material.law.empty()) continue;  // which other keys belong here is not known
      const auto& of_law = keys.at(material.law);
      TableInfo told = self;
      told.keys = infos_of(of_law);
      read_keys(found, told, of_law, &material, reading);
      set_defaults(material, *catalogue.law(material.law), found, reading);
    }
  };
  return tables;
}

}  // namespace stillpoint

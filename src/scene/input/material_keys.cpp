// The tables of materials, whose keys are the parameters and choices of their laws.
#include <map>

#include "scene/input/choice_keys.hpp"
#include "scene/input/scene_keys.hpp"

namespace stillpoint {
std::vector<TableInfo> material_tables(const Catalogue& catalogue) {
  const auto law_key =
      key_of<MaterialSpec>("law", &MaterialSpec::law, "`stillpoint list materials` has their equations",
                           {.words = names_of(catalogue.laws), .required = true});
  std::vector<TableInfo> tables = {
      {.path = "material.<name>", .help = "what bodies are made of", .repeat = Repeat::named, .keys = {law_key.info}}};
  std::map<std::string, std::vector<Key>> keys;
  for (const LawInfo& law : catalogue.laws) {
    std::vector<Key>& of_law = keys[std::string(law.name)] = keys_of_choice<MaterialSpec>(law);
    of_law.insert(of_law.begin(), law_key);
    tables.push_back({.path = "material.<name>",
                      .help = law.equation,
                      .repeat = Repeat::named,
                      .choice_key = "law",
                      .choice = law.name,
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

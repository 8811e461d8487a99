#include "scene/input/constants.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/expression_functions.hpp"
#include "scene/input/toml_source.hpp"

namespace stillpoint {
namespace {

using Pending = std::map<std::string, const toml::node*>;

/// Why a constant cannot have this name; empty if it can.
std::string fault_of_name(const std::string& name) {
  if (names_in(name) != std::vector<std::string>{name})
    return "it is not made of letters, digits and '_' only, or begins with a digit";
  if (name == "x" || name == "y" || name == "z" || name == "t") return "x, y, z and t are the variables of formulas";
  const auto& functions = expression_functions();
  if (std::find(functions.begin(), functions.end(), name) != functions.end()) return "a function has this name";
  return {};
}

/// A constant, not yet computed, that this one needs; empty if there is none.
std::string unmet_need(const toml::node& node, const Pending& pending) {
  if (const auto* text = node.as_string())
    for (const std::string& name : names_in(text->get()))
      if (pending.contains(name)) return name;
  return {};
}

/// Every pending constant needs another pending one, so following the needs from any of them ends in a circle.
std::vector<std::string> find_circle(const Pending& pending) {
  std::vector<std::string> chain = {pending.begin()->first};
  while (true) {
    const std::string next = unmet_need(*pending.at(chain.back()), pending);
    const auto seen = std::find(chain.begin(), chain.end(), next) - chain.begin();
    chain.push_back(next);
    if (seen + 1 < std::ssize(chain)) return {chain.begin() + seen, chain.end()};
  }
}

}  // namespace

void resolve_constants(const toml::table& table, Reading& reading) {
  Pending pending;
  for (auto&& [key, node] : table) {
    const std::string name(key.str());
    if (const std::string fault = fault_of_name(name); !fault.empty()) {
      reading.problem(location_of(key.source()), "constants",
                      fmt::format("{} cannot be a constant's name: {}", in_quotes(name), fault));
      reading.broken.insert(name);
    } else {
      pending[name] = &node;
    }
  }
  while (!pending.empty()) {
    bool progress = false;
    for (auto entry = pending.begin(); entry != pending.end();) {
      const auto& [name, node] = *entry;
      if (!unmet_need(*node, pending).empty()) {
        ++entry;
        continue;
      }
      if (const auto value = read_number({*node, "constants." + name, reading})) {
        reading.constants[name] = *value;
      } else {
        reading.broken.insert(name);
      }
      entry = pending.erase(entry);
      progress = true;
    }
    if (progress) continue;
    const std::vector<std::string> circle = find_circle(pending);
    reading.problem(location_of(pending.at(circle.front())->source()), "constants." + circle.front(),
                    fmt::format("is defined by itself: {}", fmt::join(circle, " → ")));
    for (const std::string& name : circle) {
      reading.broken.insert(name);
      pending.erase(name);
    }
  }
}

}  // namespace stillpoint
